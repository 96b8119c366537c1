#include "scene/triangle_bounds.h"

namespace bvhio {

PrimitiveBounds boundsOfTriangles(const Scene& scene) {
    return [&scene](std::span<const uint32_t> primitives, Aabb* boxes) {
        // Each triangle takes two dependent reads of scattered memory, its indices and their vertices. Both
        // are prefetched well ahead.
        constexpr size_t kIndicesAhead = 128, kVerticesAhead = 64;
        const TriangleIndices* triangles = scene.triangles.data();
        const Vec3* vertices = scene.vertices.data();
        for (size_t i = 0; i < primitives.size(); ++i) {
            if (i + kIndicesAhead < primitives.size())
                __builtin_prefetch(&triangles[primitives[i + kIndicesAhead]]);
            if (i + kVerticesAhead < primitives.size()) {
                const TriangleIndices& later = triangles[primitives[i + kVerticesAhead]];
                __builtin_prefetch(&vertices[later.v0]);
                __builtin_prefetch(&vertices[later.v1]);
                __builtin_prefetch(&vertices[later.v2]);
            }
            boxes[i] = bounds(scene.triangle(primitives[i]));
        }
    };
}

}  // namespace bvhio
