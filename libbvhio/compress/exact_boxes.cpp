#include "compress/exact_boxes.h"

#include <algorithm>
#include <numeric>

#include "core/clip_triangle.h"
#include "core/parallel.h"
#include "scene/triangle_bounds.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

/// Returns the smallest box around the parts of a leaf's triangles inside the leaf's box, or the leaf's box
/// if there are none.
Aabb boxOfParts(const Scene& scene, const Bvh& bvh, const Node& leaf) {
    Aabb box = Aabb::empty();
    for (uint32_t i = leaf.first; i < leaf.first + leaf.primitiveCount; ++i) {
        const Aabb part =
            intersection(partBounds(scene.triangle(bvh.primitives[i]), leaf.bounds), leaf.bounds);
        if (!part.isEmpty()) box.extend(part);
    }
    return box.isEmpty() ? leaf.bounds : box;
}

/// Returns the exact tree of a tree with split triangles.
Bvh exactTreeOfParts(const Scene& scene, const Bvh& bvh) {
    // Make each reference a primitive of its own, with its leaf's box. Then refit does the rest.
    std::vector<uint32_t> references(bvh.primitives.size());
    std::iota(references.begin(), references.end(), 0u);
    std::vector<Aabb> leafBoxes(bvh.primitives.size());
    parallelChunks(bvh.nodes.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Node& node = bvh.nodes[i];
            if (node.isLeaf())
                std::fill_n(leafBoxes.begin() + node.first, node.primitiveCount,
                            boxOfParts(scene, bvh, node));
        }
    });
    const auto boxOf = [&](std::span<const uint32_t> range, Aabb* boxes) {
        for (size_t i = 0; i < range.size(); ++i) boxes[i] = leafBoxes[range[i]];
    };
    return {refit({bvh.nodes, std::move(references)}, boxOf).nodes, bvh.primitives, bvh.slots};
}

}  // namespace

Bvh withExactBoxes(const Scene& scene, const Bvh& bvh) {
    if (bvh.primitives.size() > scene.triangles.size()) return exactTreeOfParts(scene, bvh);
    return refit(bvh, boundsOfTriangles(scene));
}

}  // namespace bvhio
