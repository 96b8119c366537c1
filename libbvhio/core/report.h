// What passes and tools say about their work, as an ordered JSON object: the only header that knows the JSON
// library.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace bvhio {

/// Keys keep the order in which they were added. NaN and infinity become null.
using Report = nlohmann::ordered_json;

/// The report as JSON, on one line when `indent` is negative. Bytes that are no UTF-8, which the names of
/// files may hold, become U+FFFD: JSON has no other place for them.
inline std::string jsonText(const Report& report, int indent = -1) {
    return report.dump(indent, ' ', false, Report::error_handler_t::replace);
}

}  // namespace bvhio
