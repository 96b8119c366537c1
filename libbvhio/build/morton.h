// The order of triangles along the Morton curve, from which bottom-up builders and LBVH start.
#pragma once

#include "core/buffer.h"
#include "scene/scene.h"

namespace bvhio {

inline constexpr uint32_t kMortonBits = 63;  // 21 per axis

/// All triangles in the order of the Morton codes of their boxes' centres. Equal codes are in the order of
/// ids.
struct MortonOrder {
    Buffer<uint32_t> triangles;
    /// For places i and i + 1, the number of leading bits that their codes share; if the codes are equal,
    /// kMortonBits plus the number of leading bits that the places themselves share. This is the level of the
    /// node that separates the two in a binary radix tree. So in any run of places one level is lowest, and
    /// less than kMortonBits + 32. The last element is unused.
    Buffer<uint8_t> levels;
    float scale;  // areaScale of the triangles' bounds
};

/// Computes the order. The grid over the scene's bounds has cubic cells: trees cost up to a tenth less than
/// with cells that are stretched to the bounds. Parallel, in time linear in the triangles.
MortonOrder mortonOrder(const Scene& scene);

}  // namespace bvhio
