#include "build/reference.h"

#include <cmath>

#include "core/parallel.h"

namespace bvhio {
namespace {

constexpr size_t kGrain = 1 << 14;

struct Extremes {
    Box bounds = Box::empty(), centroids = Box::empty();
};

Extremes referencesOf(const Scene& scene, size_t begin, size_t end, float scale, Reference* references) {
    Extremes extremes;
    for (size_t i = begin; i < end; ++i) {
        const Aabb box = bvhio::bounds(scene.triangle(i));
        const Vec3 low = box.min * scale, high = box.max * scale;
        // 0 - x, not -x: -0 would make a union depend on its order.
        const Box lanes{{0 - low.x, 0 - low.y, 0 - low.z, 0}, {high.x, high.y, high.z, 0}};
        extremes.bounds.extend(lanes);
        const float centroid[3] = {low.x + high.x, low.y + high.y, low.z + high.z};
        extremes.centroids.extendPoint(centroid);
        references[i] = {{lanes.negatedMin[0], lanes.negatedMin[1], lanes.negatedMin[2]},
                         uint32_t(i),
                         {high.x, high.y, high.z},
                         0};
    }
    return extremes;
}

Extremes referencesOf(const Scene& scene, float scale, Reference* references) {
    const size_t count = scene.triangles.size();
    std::vector<Extremes> chunks((count + kGrain - 1) / kGrain);
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        chunks[begin / kGrain] = referencesOf(scene, begin, end, scale, references);
    });
    Extremes all;
    for (const Extremes& chunk : chunks) {
        all.bounds.extend(chunk.bounds);
        all.centroids.extend(chunk.centroids);
    }
    return all;
}

}  // namespace

bool makeReferences(const Scene& scene, Buffer<Reference>& references, Box& bounds, Box& centroids) {
    references = Buffer<Reference>(scene.triangles.size());
    Extremes extremes = referencesOf(scene, 1, references.data());

    float largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(
            {largest, std::fabs(extremes.bounds.negatedMin[axis]), std::fabs(extremes.bounds.max[axis])});
    // Within 2^+-40 the area of a box, times 2^31 primitives, stays far from overflow, and so does that of a
    // box 2^-20 as large from underflow.
    const bool rescaled = largest > 0 && (largest > 0x1p40f || largest < 0x1p-40f);
    if (rescaled) {
        const float scale = std::ldexp(1.0f, std::min(-std::ilogb(largest), 127));
        extremes = referencesOf(scene, scale, references.data());
    }
    bounds = extremes.bounds;
    centroids = extremes.centroids;
    return rescaled;
}

SharedArray<Node> refitted(const Scene& scene, const Bvh& bvh) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    for (size_t i = nodes.size(); i-- > 0;) {
        if (i == 1) continue;  // the unused slot
        Node& node = nodes[i];
        node.bounds = Aabb::empty();
        if (node.isLeaf()) {
            for (uint32_t k = node.first; k < node.first + node.primitiveCount; ++k)
                node.bounds.extend(bvhio::bounds(scene.triangle(bvh.primitives[k])));
        } else {
            node.bounds = unite(nodes[node.left()].bounds, nodes[node.right()].bounds);
        }
    }
    return SharedArray<Node>(std::move(nodes));
}

}  // namespace bvhio
