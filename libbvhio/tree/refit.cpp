#include "tree/refit.h"

#include <vector>

#include "core/parallel.h"

namespace bvhio {
namespace {

/// Leaves whose boxes are computed together, so that their primitives, which lie scattered, can be
/// prefetched.
struct RefitBatch {
    std::vector<uint32_t> leaves, primitives;
    std::vector<Aabb> boxes;

    void fit(std::span<Node> nodes, const PrimitiveBounds& primitiveBounds) {
        boxes.resize(primitives.size());
        primitiveBounds(primitives, boxes.data());
        const Aabb* box = boxes.data();
        for (const uint32_t leaf : leaves) {
            Aabb bounds = Aabb::empty();
            for (const Aabb* end = box + nodes[leaf].primitiveCount; box != end; ++box) bounds.extend(*box);
            nodes[leaf].bounds = bounds;
        }
        leaves.clear();
        primitives.clear();
    }
};

}  // namespace

void fitLeaves(std::span<Node> nodes, std::span<const uint32_t> primitives,
               const PrimitiveBounds& primitiveBounds) {
    parallelChunks(nodes.size(), 16384, [&](size_t begin, size_t end) {
        RefitBatch batch;
        for (size_t i = begin; i < end; ++i) {
            if (!nodes[i].isLeaf()) continue;
            const auto range = primitives.subspan(nodes[i].first, nodes[i].primitiveCount);
            batch.leaves.push_back(uint32_t(i));
            batch.primitives.insert(batch.primitives.end(), range.begin(), range.end());
            if (batch.primitives.size() >= 1024) batch.fit(nodes, primitiveBounds);
        }
        batch.fit(nodes, primitiveBounds);
    });
}

Bvh refit(const Bvh& bvh, const PrimitiveBounds& primitiveBounds) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    fitLeaves(nodes, bvh.primitives, primitiveBounds);
    // Children come after their parents, so a reverse sweep meets them first.
    for (size_t i = nodes.size(); i-- > 0;)
        if (i != 1 && !nodes[i].isLeaf())
            nodes[i].bounds = unite(nodes[nodes[i].left()].bounds, nodes[nodes[i].right()].bounds);
    return {std::move(nodes), bvh.primitives, bvh.slots};
}

}  // namespace bvhio
