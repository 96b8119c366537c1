// An instance: a mesh of the scene that stands somewhere in the world, and what a hit of it is.
//
// An affine transform of 12 floats takes the mesh's own space to the world. A ray R of the world becomes a
// ray R' of the mesh's space (`objectRay`): its origin and direction through the inverse transform, in
// double, each number rounded once to float. The direction is not normalised, so a point of R and its image
// on R' have the same parameter t. By definition the instance's triangle T is hit at t when
//     hitTriangle accepts T for R' at t  (core/intersect.h),  and
//     near(B) <= far(B)  and  near(B) <= widen(t)  for R and the instance's box B in the world.
// The box test makes culling in the world exact, as the triangle's own box does in the mesh's space: each box
// of a tree over instances contains B, so near(box) <= near(B), and a box that the traversal culls with
// widen(best t) holds only instances whose hits at t <= best it would not accept. Within the mesh the
// argument of core/intersect.h holds for R' as it stands: t is the same parameter, and so are the limits of
// R. So closest hits, with the lowest id among equal t, are those of brute force over all instances and their
// triangles, however the rounding falls.
//
// The test should practically never refuse what the first line accepts. Rounding moves R' by at most 2^-24 of
// its coordinates on each axis of the mesh's space; carried back to the world this is, on each axis, at most
// 2^-24 of a sum of the terms that `placedBox` adds up for a point where the ray passes, plus as much of
// the way between the ray's origin and that point. The box has a margin of 64 times the former; the slack of
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

/// Where the transform takes a point: computed in double, rounded once, -0 as +0.
Vec3 place(const Affine& objectToWorld, Vec3 point);

/// The world's way back to a mesh's space: p -> linear * (p - translation), linear row by row.
struct WorldToObject {
    std::array<double, 9> linear;
    std::array<double, 3> translation;
};

/// Nothing when the transform has a number that is not finite, or a determinant that computes to 0.
std::optional<WorldToObject> inverse(const Affine& objectToWorld);

/// The ray in the mesh's space. It may miss by definition, as one of PreparedRay does, when a number
/// overflows or all of its direction rounds to 0.
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

/// The box in the world of an instance whose mesh has the given box: that of the eight corners, in double,
/// with a margin of 2^-18 of the sum of the magnitudes that a coordinate is made of, rounded outwards to
/// float and cut off at the largest floats.
Aabb placedBox(const Affine& objectToWorld, const Aabb& meshBounds);

/// On each axis, the largest sum of magnitudes that a coordinate of a point of the box is made of: what the
/// rounding errors of the instance's hits are proportional to.
std::array<double, 3> placedMagnitude(const Affine& objectToWorld, const Aabb& meshBounds);

/// What a ray needs to enter an instance: two cache lines.
struct alignas(64) InstanceEntry {
    WorldToObject toObject;
    Aabb bounds;  // in the world
    uint32_t mesh;
    uint32_t primitiveOffset;  // plus a triangle's index in the scene: its id in hits, modulo 2^32
};
static_assert(sizeof(InstanceEntry) == 128);

/// The entries of all instances of a scene.
std::vector<InstanceEntry> instanceEntries(const Scene& scene);

}  // namespace bvhio
