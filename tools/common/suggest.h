// "Did you mean": the nearest of some names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bvhio {

/// The name that differs from `word` in the fewest letters, or "" when every name differs in too many to be
/// meant.
std::string_view nearestName(std::string_view word, std::span<const std::string_view> names);

}  // namespace bvhio
