// Sorting by Morton code.
#pragma once

#include <span>

#include "build/morton.h"

namespace bvhio {

/// The order of codes, which fill the high kMortonBits bits of their words: `triangles` and `levels` of a
/// MortonOrder, as long as `codes`. Parallel.
void sortCodes(std::span<const uint64_t> codes, uint32_t* triangles, uint8_t* levels);

}  // namespace bvhio
