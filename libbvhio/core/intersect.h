// The one ray-box test and the one ray-triangle test: the definition of a hit, for every tree, form and tool.
//
// Triangles: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: translate
// the triangle to the ray's origin, shear it so that the ray becomes the z axis, and test whether the origin
// of the plane lies in the projected triangle. We depart from the paper in three ways. Everything is computed
// in double, so its float-to-double fallback is not needed, and no size or place of a scene loses precision.
// (Few triangles get here: trace/triangle_blocks rejects the others in float, four at a time.) The parameter
// t comes from the plane equation: for axis-aligned triangles its error is small relative to t itself,
// however near the origin lies to a large triangle. And a hit must pass the box test below.
//
// Why no ray slips between two triangles that share an edge. Both triangles have the same two sheared
// vertices, and compute the edge function as the difference of the same two rounded products, one of them
// with its sign flipped. Rounding is monotone, so each difference has the exact sign or is zero, and zero
// counts as inside. So at least those triangles accept a ray that exact arithmetic would find over the same
// sheared vertices, and these form a closed surface if the mesh is one.
//
// Why every tree, form and order of traversal finds the same hits. Let near(B), far(B) be the interval that
// `clipToBox` finds for box B. Each is made of planes by subtraction, multiplication by a constant, min and
// max, whose rounded versions are all monotone: if box C contains box B then near(C) <= near(B) and far(C) >=
// far(B), bit for bit. Let `widen` be the (monotone) function below. By definition (`hitTriangle`) a triangle
// with bounds B is hit at t only if
//     near(B) <= far(B)  and  near(B) <= widen(t).
// Each box above that triangle contains B, so it passes the same test for this t and for every larger t.
// Traversal culls a box only by that test with widen(best t so far), so it never culls the box of a triangle
// whose t is less than or EQUAL to the best t. So closest hits, with the lowest index among equal t, and any
// hits are those of brute force over all triangles, whatever the rounding does. A form that stores larger
// boxes finds the same hits if it obeys one contract:
//     a form's step must accept a child whenever `clipToBox` accepts any box that lies inside the child's
//     stored box.
// Where spatial splits leave only a part of a triangle in a leaf, the same follows from the slack in
// `clipToBox`: its error is a few units in the last place of the plane's t, and the interval is widened by
// more than that plus the error of t. The boxes of parts have a margin for the rest: core/clip_triangle.h.
//
// That slack also makes the box test harmless. Let the exact ray pass within the double-precision error of a
// point P of the triangle, at parameter t. A computed plane parameter differs from the exact one by a factor
// within (1 +- 2^-24)^4 (difference, reciprocal, reciprocal times slack, product), and kSlack = 2^-21 is
// twice that, so near(B) <= t and t <= far(B) for every box B that holds P.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "core/ray.h"
#include "core/triangle.h"

/// Marks the small functions of the hot loops. They must be inlined into code that is compiled once for each
/// of several processors.
#define BVHIO_INLINE inline __attribute__((always_inline))

namespace bvhio {

inline constexpr float kSlack = 0x1p-21f;

/// Returns the largest parameter at which boxes are still entered when a hit at `t` is known. The entry of a
/// flat box may round to slightly above the t of the triangle in it.
BVHIO_INLINE float widen(float t) {
    return t * (1 + kSlack);
}

/// A ray, and all values that the box and triangle tests derive from it.
struct PreparedRay {
    Vec3 origin;
    float tMin;  // >= 0
    Vec3 direction;
    float tMax;                          // < tMin for a ray that misses by definition
    Vec3 nearReciprocal, farReciprocal;  // 1 / direction, a little too small and a little too large
    // Which of {min.x, min.y, min.z, max.x, max.y, max.z} the ray meets first, and last, by axis.
    uint32_t nearPlane[3], farPlane[3];
    int axisX, axisY, axisZ;  // axisZ: where the direction is largest
    double shearX, shearY;    // direction[axisX], direction[axisY] over direction[axisZ]

    explicit PreparedRay(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
        // A negative tMin counts as 0. This comparison keeps a NaN, which then fails the test for validity.
        tMin = ray.tMin < 0 ? 0 : ray.tMin;
        tMax = ray.tMax;
        const bool valid = isFinite(origin) && isFinite(direction) && direction != Vec3{} && tMin <= tMax;
        if (!valid) {
            tMin = 0;
            tMax = -1;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float d = direction[axis], reciprocal = 1 / d;
            nearReciprocal[axis] = reciprocal * (1 - kSlack);
            farReciprocal[axis] = reciprocal * (1 + kSlack);
            const bool backwards = std::signbit(d);  // true for -0, whose reciprocal is -infinity
            nearPlane[axis] = uint32_t(backwards ? axis + 3 : axis);
            farPlane[axis] = uint32_t(backwards ? axis : axis + 3);
        }
        const float x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
        axisZ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        axisX = axisZ == 2 ? 0 : axisZ + 1;
        axisY = axisX == 2 ? 0 : axisX + 1;
        shearX = double(component(direction, axisX)) / component(direction, axisZ);
        shearY = double(component(direction, axisY)) / component(direction, axisZ);
    }

    bool missesByDefinition() const { return !(tMin <= tMax); }
};

/// The part of a ray inside a box; empty if !(enter <= exit).
struct RayInterval {
    float enter, exit;
    BVHIO_INLINE bool isEmpty() const { return !(enter <= exit); }
};

/// Returns the part of the ray between tMin and `tLimit` that is inside the box whose planes, {min.x, min.y,
/// min.z, max.x, max.y, max.z}, start at `planes`. A ray that lies in a plane gives a product of zero and
/// infinity: a NaN, which fails each comparison and leaves the interval as it is.
BVHIO_INLINE RayInterval clipToPlanes(const PreparedRay& ray, const float* planes, float tLimit) {
#if defined(__SSE__)
    // The same arithmetic as below, by the processor's scalar instructions: maxss(a, b) is a > b ? a : b,
    // NaNs included. Compilers turn the comparisons below into integer moves or branches, which halves the
    // speed of the traversal loop.
    const auto at = [&](uint32_t plane, const float& origin, const float& reciprocal) {
        return _mm_mul_ss(_mm_sub_ss(_mm_load_ss(planes + plane), _mm_load_ss(&origin)),
                          _mm_load_ss(&reciprocal));
    };
    __m128 enter =
        _mm_max_ss(at(ray.nearPlane[0], ray.origin.x, ray.nearReciprocal.x), _mm_load_ss(&ray.tMin));
    enter = _mm_max_ss(at(ray.nearPlane[1], ray.origin.y, ray.nearReciprocal.y), enter);
    enter = _mm_max_ss(at(ray.nearPlane[2], ray.origin.z, ray.nearReciprocal.z), enter);
    __m128 exit = _mm_min_ss(at(ray.farPlane[0], ray.origin.x, ray.farReciprocal.x), _mm_set_ss(tLimit));
    exit = _mm_min_ss(at(ray.farPlane[1], ray.origin.y, ray.farReciprocal.y), exit);
    exit = _mm_min_ss(at(ray.farPlane[2], ray.origin.z, ray.farReciprocal.z), exit);
    return {_mm_cvtss_f32(enter), _mm_cvtss_f32(exit)};
#else
    const auto at = [&](uint32_t plane, float origin, float reciprocal) {
        return (planes[plane] - origin) * reciprocal;
    };
    const auto larger = [](float a, float otherwise) { return a > otherwise ? a : otherwise; };
    const auto smaller = [](float a, float otherwise) { return a < otherwise ? a : otherwise; };
    float enter = larger(at(ray.nearPlane[0], ray.origin.x, ray.nearReciprocal.x), ray.tMin);
    enter = larger(at(ray.nearPlane[1], ray.origin.y, ray.nearReciprocal.y), enter);
    enter = larger(at(ray.nearPlane[2], ray.origin.z, ray.nearReciprocal.z), enter);
    float exit = smaller(at(ray.farPlane[0], ray.origin.x, ray.farReciprocal.x), tLimit);
    exit = smaller(at(ray.farPlane[1], ray.origin.y, ray.farReciprocal.y), exit);
    exit = smaller(at(ray.farPlane[2], ray.origin.z, ray.farReciprocal.z), exit);
    return {enter, exit};
#endif
}

BVHIO_INLINE RayInterval clipToBox(const PreparedRay& ray, const Aabb& box, float tLimit) {
    return clipToPlanes(ray, &box.min.x, tLimit);
}

/// Returns whether the ray hits the triangle at a finite t in [tMin, tLimit], from either side. If so, sets
/// t, u and v of `hit`, but not its primitive. The ray must be valid.
inline bool hitTriangle(const PreparedRay& ray, const Triangle& triangle, float tLimit, Hit& hit) {
    struct Point {
        double x, y, z;
    };
    const auto relative = [&](const Vec3& v) {
        return Point{double(component(v, ray.axisX)) - component(ray.origin, ray.axisX),
                     double(component(v, ray.axisY)) - component(ray.origin, ray.axisY),
                     double(component(v, ray.axisZ)) - component(ray.origin, ray.axisZ)};
    };
    const Point a = relative(triangle.v0), b = relative(triangle.v1), c = relative(triangle.v2);
    const double ax = a.x - ray.shearX * a.z, ay = a.y - ray.shearY * a.z;
    const double bx = b.x - ray.shearX * b.z, by = b.y - ray.shearY * b.z;
    const double cx = c.x - ray.shearX * c.z, cy = c.y - ray.shearY * c.z;

    // The edge functions are twice the areas that the ray spans with each edge: the weights of v0, v1 and v2.
    const double weight0 = cx * by - cy * bx;
    const double weight1 = ax * cy - ay * cx;
    const double weight2 = bx * ay - by * ax;
    if ((weight0 < 0 || weight1 < 0 || weight2 < 0) && (weight0 > 0 || weight1 > 0 || weight2 > 0))
        return false;
    const double sum = weight0 + weight1 + weight2;
    if (sum == 0) return false;

    // The ray meets the triangle's plane at t = normal . (v0 - origin) / normal . direction.
    const Point e{b.x - a.x, b.y - a.y, b.z - a.z}, f{c.x - a.x, c.y - a.y, c.z - a.z};
    const Point normal{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
    const double height = normal.x * a.x + normal.y * a.y + normal.z * a.z;
    const double speed = normal.x * component(ray.direction, ray.axisX) +
                         normal.y * component(ray.direction, ray.axisY) +
                         normal.z * component(ray.direction, ray.axisZ);
    const float t = float(height / speed) + 0.0f;  // + 0 turns -0 into 0
    if (!(t >= ray.tMin && t <= tLimit && t <= std::numeric_limits<float>::max())) return false;
    if (clipToBox(ray, bounds(triangle), widen(t)).isEmpty()) return false;
    hit.t = t;
    hit.u = float(weight1 / sum) + 0.0f;
    hit.v = float(weight2 / sum) + 0.0f;
    return true;
}

}  // namespace bvhio
