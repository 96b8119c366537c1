// What passes and tools say about their work, as an ordered JSON object: the only header that knows the JSON
// library.
#pragma once

#include <nlohmann/json.hpp>

namespace bvhio {

/// Keys keep the order in which they were added. NaN and infinity become null.
using Report = nlohmann::ordered_json;

}  // namespace bvhio
