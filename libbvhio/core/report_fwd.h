// The name of reports, for headers that only mention them: the JSON library costs a second to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace bvhio {

/// See core/report.h.
using Report = nlohmann::ordered_json;

}  // namespace bvhio
