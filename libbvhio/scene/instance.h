// An instance is a mesh of the scene that is placed in the world. This file defines its hits.
//
// An affine transform of 12 floats takes the mesh's own space to the world. A ray R of the world becomes a
// ray R' of the mesh's space (`objectRay`): the inverse transform is applied to its origin and direction in
// double, and each number is rounded once to float. The direction is not normalised, so a point of R and its
// image on R' have the same parameter t. By definition the instance's triangle T is hit at t if
//     hitTriangle accepts T for R' at t  (core/intersect.h),  and
//     near(B) <= far(B)  and  near(B) <= widen(t)  for R and the instance's box B in the world.
// The box test makes culling in the world exact, as the triangle's own box does in the mesh's space. Each box
// of a tree over instances contains B, so near(box) <= near(B). A box that the traversal culls with
// widen(best t) only holds instances whose hits at t <= best the definition would not accept. Within the
// mesh, the argument of core/intersect.h holds for R' unchanged, since t and the limits of R are the same. So
// closest hits, with the lowest id among equal t, are those of brute force over all instances and their
// triangles, whatever the rounding does.
//
// The box test should practically never reject what the first line accepts. Rounding moves R' by at most
// 2^-24 of its coordinates on each axis of the mesh's space. In the world this is, on each axis, at most
// 2^-24 of the sum of terms that `placedBox` adds up for a point where the ray passes, plus 2^-24 of the
// distance between the ray's origin and that point. The box has a margin of 64 times the former. The slack of
// `clipToBox` and `widen`, relative to t, covers the latter.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/intersect.h"
#include "core/triangle.h"

namespace bvhio {

struct Scene;

/// The upper 3 x 4 of an affine matrix, row by row, from a mesh's own space to the world.
using Affine = std::array<float, 12>;
inline constexpr Affine kIdentityAffine{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// Transforms a point, in double and rounded once; -0 becomes +0.
Vec3 place(const Affine& objectToWorld, Vec3 point);

/// The transform from the world to a mesh's space: p -> linear * (p - translation), with `linear` row by row.
struct WorldToObject {
    std::array<double, 9> linear;
    std::array<double, 3> translation;
};

/// Inverts a transform. Returns nothing if a number is not finite or the determinant computes to 0.
std::optional<WorldToObject> inverse(const Affine& objectToWorld);

/// Returns the ray in the mesh's space. If a number overflows, or the whole direction rounds to 0, this ray
/// misses by definition (core/ray.h).
BVHIO_INLINE Ray objectRay(const WorldToObject& to, const PreparedRay& ray) {
    const auto rotate = [&](double x, double y, double z) {
        const auto row = [&](size_t r) {
            return float(to.linear[r] * x + to.linear[r + 1] * y + to.linear[r + 2] * z);
        };
        return Vec3{row(0), row(3), row(6)};
    };
    return {rotate(double(ray.origin.x) - to.translation[0], double(ray.origin.y) - to.translation[1],
                   double(ray.origin.z) - to.translation[2]),
            ray.tMin, rotate(ray.direction.x, ray.direction.y, ray.direction.z), ray.tMax};
}

/// Returns the box in the world of an instance whose mesh has the given box: the box of the eight corners, in
/// double, plus a margin of 2^-18 of the sum of the magnitudes that make up a coordinate. It is rounded
/// outwards to float and limited to the largest floats.
Aabb placedBox(const Affine& objectToWorld, const Aabb& meshBounds);

/// Returns for each axis the largest sum of magnitudes that make up a coordinate of a point of the box. The
/// rounding errors of the instance's hits are proportional to it.
std::array<double, 3> placedMagnitude(const Affine& objectToWorld, const Aabb& meshBounds);

/// The data that a ray needs to enter an instance, in two cache lines.
struct alignas(64) InstanceEntry {
    WorldToObject toObject;
    Aabb bounds;  // in the world
    uint32_t mesh;
    uint32_t primitiveOffset;  // added to a triangle's index in the scene, modulo 2^32, gives its id in hits
};
static_assert(sizeof(InstanceEntry) == 128);

/// Returns the entries of all instances of a scene.
std::vector<InstanceEntry> instanceEntries(const Scene& scene);

}  // namespace bvhio
