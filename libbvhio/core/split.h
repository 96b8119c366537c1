// Splits a text at its separators, for options that name several things in one word.
#pragma once

#include <string_view>
#include <vector>

namespace bvhio {

/// Returns the parts between separators: one more than there are separators. Any part may be empty.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const size_t at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

}  // namespace bvhio
