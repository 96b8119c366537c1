// Counts in messages: "1 node", "2 nodes".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace bvhio {

/// The count and its noun; `plural` is for nouns that do not just add an s.
inline std::string counted(uint64_t count, std::string_view noun, std::string_view plural = "") {
    const std::string text = std::to_string(count) + " ";
    if (count == 1) return text + std::string(noun);
    return plural.empty() ? text + std::string(noun) + "s" : text + std::string(plural);
}

}  // namespace bvhio
