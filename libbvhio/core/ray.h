// Rays and hits, and which rays miss by definition.
#pragma once

#include <cstdint>
#include <limits>

#include "core/vec3.h"

namespace bvhio {

/// A ray: the points origin + t * direction with tMin <= t <= tMax. `t` is in units of the direction, which
/// need not be normalised. 32 bytes, with the fields in the order of a `.rays` file. A negative tMin counts
/// as 0. A ray with a NaN anywhere, an infinite origin or direction, a zero direction or tMax < tMin is valid
/// input, and by definition hits nothing.
struct Ray {
    Vec3 origin;
    float tMin = 0;
    Vec3 direction;
    float tMax = std::numeric_limits<float>::infinity();
};
static_assert(sizeof(Ray) == 32);

inline constexpr uint32_t kNoPrimitive = 0xFFFFFFFFu;

/// The answer to a closest-hit query. `primitive` is the index of the triangle in `Scene::triangles`; in an
/// instanced scene, it is the triangle's number through all instances (see Scene). Among equal t the lowest
/// number wins. u and v are the barycentric weights of the second and third vertex. A miss has primitive ==
/// kNoPrimitive, t = infinity and u = v = 0.
struct Hit {
    float t = std::numeric_limits<float>::infinity();
    float u = 0, v = 0;
    uint32_t primitive = kNoPrimitive;

    bool isMiss() const { return primitive == kNoPrimitive; }
    bool operator==(const Hit&) const = default;
};

}  // namespace bvhio
