// Triangles, their bounds and their areas.
#pragma once

#include "core/aabb.h"

namespace bvhio {

/// Three vertices in source order; 36 bytes.
struct Triangle {
    Vec3 v0, v1, v2;
};

constexpr Aabb bounds(const Triangle& t) {
    return {min(min(t.v0, t.v1), t.v2), max(max(t.v0, t.v1), t.v2)};
}

/// Returns the area in units squared, computed in double so that the area of a tiny triangle is not 0.
inline double area(const Triangle& t) {
    const double ax = double(t.v1.x) - t.v0.x, ay = double(t.v1.y) - t.v0.y, az = double(t.v1.z) - t.v0.z;
    const double bx = double(t.v2.x) - t.v0.x, by = double(t.v2.y) - t.v0.y, bz = double(t.v2.z) - t.v0.z;
    const double cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
    return 0.5 * std::sqrt(cx * cx + cy * cy + cz * cz);
}

}  // namespace bvhio
