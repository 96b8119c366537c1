// What passes and tools say about their work, as an ordered JSON object. Headers that only mention Report
// include core/report_fwd.h.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/report_fwd.h"

namespace bvhio {

// In a Report, keys keep the order in which they were added. NaN and infinity become null.

/// The report as JSON, on one line when `indent` is negative. Bytes that are no UTF-8, which the names of
/// files may hold, become U+FFFD: JSON has no other place for them.
std::string jsonText(const Report& report, int indent = -1);

}  // namespace bvhio
