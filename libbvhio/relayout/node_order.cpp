#include "relayout/node_order.h"

#include <algorithm>
#include <array>

namespace bvhio {
namespace {

/// Rewrites the leaves' ranges so that they follow each other in depth-first order. Returns the primitives in
/// that order.
AlignedVector<uint32_t> gatherPrimitives(AlignedVector<Node>& nodes, const SharedArray<uint32_t>& old) {
    AlignedVector<uint32_t> primitives(old.size());
    uint32_t next = 0;
    std::array<uint32_t, kMaxDepth + 1> stack;  // right siblings that wait, at most one per level
    size_t waiting = 0;
    for (uint32_t index = 0;;) {
        Node& node = nodes[index];
        if (!node.isLeaf()) {
            stack[waiting++] = node.right();
            index = node.left();
            continue;
        }
        std::copy_n(old.begin() + node.first, node.primitiveCount, primitives.begin() + next);
        node.first = next;
        next += node.primitiveCount;
        if (waiting == 0) return primitives;
        index = stack[--waiting];
    }
}

}  // namespace

Bvh applyNodeOrder(const Bvh& bvh, const NodeOrder& order) {
    AlignedVector<Node> nodes(bvh.nodes.size());
    nodes[0] = bvh.nodes[0];
    nodes[1] = {};
    std::vector<uint32_t> newIndex(bvh.nodes.size());  // of a pair's left node, by its old index
    for (size_t i = 0; i < order.size(); ++i) {
        const auto left = uint32_t(2 * i + 2);
        newIndex[order[i]] = left;
        nodes[left] = bvh.nodes[order[i]];
        nodes[left + 1] = bvh.nodes[order[i] + 1];
    }
    for (size_t i = 0; i < nodes.size(); ++i)
        if (i != 1 && !nodes[i].isLeaf()) nodes[i].first = newIndex[nodes[i].left()];
    AlignedVector<uint32_t> primitives = gatherPrimitives(nodes, bvh.primitives);
    return {std::move(nodes), std::move(primitives)};
}

std::vector<uint32_t> inNodeOrder(std::span<const uint32_t> ofPairs, const NodeOrder& order) {
    std::vector<uint32_t> moved{ofPairs[0]};
    for (const uint32_t left : order) moved.push_back(ofPairs[left / 2]);
    return moved;
}

}  // namespace bvhio
