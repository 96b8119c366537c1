// References, which builders sort instead of triangles, and their box arithmetic.
#pragma once

#include "core/buffer.h"
#include "core/parallel.h"
#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// A box as two groups of four floats, (-min, unused) and (max, unused). So the union of two boxes is one
/// maximum of eight floats, the extent is one sum of four floats, and the doubled centroid is one difference.
/// The unused lanes may hold anything; nothing reads them.
struct alignas(32) Box {
    float negatedMin[4];
    float max[4];

    static Box empty() {
        constexpr float inf = std::numeric_limits<float>::infinity();
        return {{-inf, -inf, -inf, -inf}, {-inf, -inf, -inf, -inf}};
    }
    void extend(const Box& b) {
        for (int i = 0; i < 4; ++i) {
            negatedMin[i] = b.negatedMin[i] > negatedMin[i] ? b.negatedMin[i] : negatedMin[i];
            max[i] = b.max[i] > max[i] ? b.max[i] : max[i];
        }
    }
    void extendPoint(const float* p) {
        for (int i = 0; i < 3; ++i) {
            negatedMin[i] = -p[i] > negatedMin[i] ? -p[i] : negatedMin[i];
            max[i] = p[i] > max[i] ? p[i] : max[i];
        }
    }
    float extent(int axis) const { return max[axis] + negatedMin[axis]; }
    int longestAxis() const {
        return extent(0) >= extent(1) && extent(0) >= extent(2) ? 0 : extent(1) >= extent(2) ? 1 : 2;
    }
    float halfArea() const {
        const float x = extent(0), y = extent(1), z = extent(2);
        return x * y + y * z + z * x;
    }
    /// Uses 0 - v, not -v: a minimum of 0 must not become -0.
    Aabb toAabb() const {
        return {{0 - negatedMin[0], 0 - negatedMin[1], 0 - negatedMin[2]}, {max[0], max[1], max[2]}};
    }
};

/// A primitive's box and, in the bits of an unused lane, its index: 32 bytes.
struct alignas(32) Reference {
    float negatedMin[3];
    uint32_t primitive;
    float max[3];
    uint32_t unused;

    /// Returns twice the centroid of the box.
    float centroid(int axis) const { return max[axis] - negatedMin[axis]; }
};
static_assert(sizeof(Reference) == sizeof(Box));

/// Returns the union of the boxes that `boundsOf(begin, end)` returns for chunks of `count` items.
template <class BoundsOf>
Box boundsOfChunks(size_t count, const BoundsOf& boundsOf) {
    constexpr size_t kGrain = 1 << 13;
    std::vector<Box> chunks((count + kGrain - 1) / kGrain);
    parallelChunks(count, kGrain,
                   [&](size_t begin, size_t end) { chunks[begin / kGrain] = boundsOf(begin, end); });
    Box bounds = Box::empty();
    for (const Box& chunk : chunks) bounds.extend(chunk);
    return bounds;
}

/// Returns the bounds of the doubled centroids of a run of references.
Box centroidBounds(const Reference* references, size_t count);

/// Returns the factor for coordinates with which areas stay in the range of a float: 1, or the power of two
/// that brings very large or very small coordinates to about 1.
float areaScale(const Box& bounds);

/// Makes the references of all triangles, in order, with space for `room` more after them, and computes their
/// bounds. Returns true if the boxes are scaled (areaScale is not 1), so that the boxes of the tree need
/// refitting.
bool makeReferences(const Scene& scene, Buffer<Reference>& references, Box& bounds, size_t room = 0);

/// Returns the nodes of `bvh` with boxes recomputed from the triangles.
SharedArray<Node> refitted(const Scene& scene, const Bvh& bvh);

}  // namespace bvhio
