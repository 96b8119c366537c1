// Triangles along the Morton curve: what bottom-up builders and LBVH start from.
#pragma once

#include "core/buffer.h"
#include "scene/scene.h"

namespace bvhio {

inline constexpr uint32_t kMortonBits = 63;  // 21 an axis

/// All triangles in the order of the Morton codes of their boxes' centres, equal codes in the order of ids.
struct MortonOrder {
    Buffer<uint32_t> triangles;
    /// Between places i and i + 1: how many leading bits the codes share; where codes are equal, kMortonBits
    /// and the leading bits that the places themselves share. So the level is that of the binary radix tree's
    /// node which parts the two: a run of places has one lowest level, less than kMortonBits + 32. The last
    /// element is unused.
    Buffer<uint8_t> levels;
    float scale;  // areaScale of the triangles' bounds
};

/// Codes on a grid over the scene's bounds, of cubes: trees cost up to a tenth less than over cells stretched
/// to the bounds. Parallel; time linear in the triangles.
MortonOrder mortonOrder(const Scene& scene);

}  // namespace bvhio
