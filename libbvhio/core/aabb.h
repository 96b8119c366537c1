// Axis-aligned bounding boxes.
#pragma once

#include <limits>

#include "core/vec3.h"

namespace bvhio {

/// A closed axis-aligned box [min, max]; 24 bytes, plain data. Flat boxes (min == max on an axis) are valid.
struct Aabb {
    Vec3 min, max;

    /// Returns the box that contains nothing: the neutral element of `extend`.
    static constexpr Aabb empty() {
        constexpr float inf = std::numeric_limits<float>::infinity();
        return {{inf, inf, inf}, {-inf, -inf, -inf}};
    }
    constexpr bool isEmpty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    constexpr void extend(Vec3 p) {
        min = bvhio::min(min, p);
        max = bvhio::max(max, p);
    }
    constexpr void extend(const Aabb& b) {
        min = bvhio::min(min, b.min);
        max = bvhio::max(max, b.max);
    }
    constexpr bool contains(const Aabb& b) const {
        return min.x <= b.min.x && min.y <= b.min.y && min.z <= b.min.z && max.x >= b.max.x &&
               max.y >= b.max.y && max.z >= b.max.z;
    }
    constexpr Vec3 extent() const { return max - min; }
    /// Returns the midpoint, as a sum of halves that cannot overflow.
    constexpr Vec3 center() const { return min * 0.5f + max * 0.5f; }
    constexpr int longestAxis() const {
        const Vec3 e = extent();
        return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    }
    constexpr bool operator==(const Aabb&) const = default;
};
static_assert(sizeof(Aabb) == 24);

constexpr Aabb unite(Aabb a, const Aabb& b) {
    a.extend(b);
    return a;
}

/// Returns half of a box's surface area in units squared; 0 for an empty box. The SAH needs ratios of areas,
/// so halves do. In double: the areas of boxes 1e-25 or 1e25 across must not underflow or overflow.
constexpr double halfArea(const Aabb& b) {
    if (b.isEmpty()) return 0;
    const double x = double(b.max.x) - b.min.x, y = double(b.max.y) - b.min.y, z = double(b.max.z) - b.min.z;
    return x * y + y * z + z * x;
}

}  // namespace bvhio
