#include "core/refit.h"

#include <vector>

#include "core/parallel.h"

namespace bvhio {

Bvh refit(const Bvh& bvh, const PrimitiveBounds& primitiveBounds) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    const std::span<const uint32_t> primitives = bvh.primitives;
    parallelChunks(nodes.size(), 16384, [&](size_t begin, size_t end) {
        std::vector<Aabb> boxes;
        for (size_t i = begin; i < end; ++i) {
            if (!nodes[i].isLeaf()) continue;
            boxes.resize(nodes[i].primitiveCount);
            primitiveBounds(primitives.subspan(nodes[i].first, nodes[i].primitiveCount), boxes.data());
            nodes[i].bounds = Aabb::empty();
            for (const Aabb& box : boxes) nodes[i].bounds.extend(box);
        }
    });
    // Children lie behind their parents, so a reverse sweep meets them first.
    for (size_t i = nodes.size(); i-- > 0;)
        if (i != 1 && !nodes[i].isLeaf())
            nodes[i].bounds = unite(nodes[nodes[i].left()].bounds, nodes[nodes[i].right()].bounds);
    return {std::move(nodes), bvh.primitives};
}

}  // namespace bvhio
