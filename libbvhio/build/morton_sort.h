// Sorting by Morton code.
#pragma once

#include <span>

#include "build/morton.h"

namespace bvhio {

/// Sorts codes, which are in the high kMortonBits bits of their words. Writes `triangles` and `levels` of a
/// MortonOrder, which are as long as `codes`. Parallel.
void sortCodes(std::span<const uint64_t> codes, uint32_t* triangles, uint8_t* levels);

}  // namespace bvhio
