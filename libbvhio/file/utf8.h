// Well-formed UTF-8 (RFC 3629): names and options come from outside, and end in terminals and JSON.
#pragma once

#include <string>
#include <string_view>

namespace bvhio {

bool isUtf8(std::string_view text);

/// The text with each byte that is not part of well-formed UTF-8 replaced by U+FFFD.
std::string toUtf8(std::string_view text);

}  // namespace bvhio
