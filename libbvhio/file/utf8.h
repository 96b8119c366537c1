// Well-formed UTF-8 (RFC 3629). Names and options come from outside, and are written to terminals and JSON.
#pragma once

#include <string>
#include <string_view>

namespace bvhio {

bool isUtf8(std::string_view text);

/// Returns the text with each byte that is not part of well-formed UTF-8 replaced by U+FFFD.
std::string toUtf8(std::string_view text);

}  // namespace bvhio
