#include "compress/two_levels.h"

#include "core/buffer.h"

namespace bvhio {
namespace {

/// Returns the number of primitives below each node.
Buffer<uint32_t> primitivesBelow(const Bvh& bvh) {
    Buffer<uint32_t> counts(bvh.nodes.size());
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        const Node& node = bvh.nodes[i];
        // This cannot overflow: the sum over all leaves is the number of references, which is a uint32_t.
        counts[i] = node.isLeaf() ? node.primitiveCount
                    : i == 1      ? 0
                                  : counts[node.left()] + counts[node.right()];
    }
    return counts;
}

}  // namespace

TwoLevels cutTree(const Bvh& bvh, uint32_t maxSize) {
    const size_t slots = bvh.nodes.size();
    const Buffer<uint32_t> counts = primitivesBelow(bvh);
    const auto isCut = [&](size_t i) { return counts[i] <= maxSize || bvh.nodes[i].isLeaf(); };

    // Find the tree of each pair, or kTop if the pair is above the cut, and the pair's place in it.
    constexpr uint32_t kTop = ~0u;
    Buffer<uint32_t> treeOf(slots / 2), placeOf(slots / 2);
    std::vector<uint32_t> pairsOfTree;
    uint32_t topPairs = 0;
    treeOf[0] = kTop;
    for (size_t i = 0; i < slots; ++i) {
        if (i == 1) continue;
        const Node& node = bvh.nodes[i];
        uint32_t tree = treeOf[i / 2];
        if (i % 2 == 0) placeOf[i / 2] = tree == kTop ? topPairs++ : pairsOfTree[tree]++;
        if (tree == kTop && isCut(i)) {
            tree = uint32_t(pairsOfTree.size());
            pairsOfTree.push_back(0);
        }
        if (!node.isLeaf()) treeOf[node.left() / 2] = tree;
    }

    // Turn the counts of pairs into the first pair of each tree.
    const size_t trees = pairsOfTree.size();
    uint32_t bottomPairs = 0;
    for (uint32_t& pairs : pairsOfTree) {
        const uint32_t first = bottomPairs;
        bottomPairs += pairs;
        pairs = first;
    }

    // Copy the nodes to their places.
    Buffer<Node> top(2 * size_t(topPairs)), roots(trees), nodes(2 * size_t(bottomPairs));
    top[1] = {};
    uint32_t tree = 0;
    for (size_t i = 0; i < slots; ++i) {
        if (i == 1) continue;
        Node node = bvh.nodes[i];
        const uint32_t own = treeOf[i / 2];
        const size_t place = 2 * size_t(placeOf[i / 2]) + i % 2;
        if (!node.isLeaf()) {
            const uint32_t below = treeOf[node.left() / 2];
            node.first = 2 * (placeOf[node.left() / 2] + (below == kTop ? 0 : pairsOfTree[below]));
        }
        if (own != kTop) {
            nodes[2 * size_t(pairsOfTree[own]) + place] = node;
        } else if (isCut(i)) {
            roots[tree] = node;
            top[place] = {node.bounds, tree++, 1};
        } else {
            top[place] = node;
        }
    }
    return {{std::move(top).share(), {}}, {std::move(roots).share(), std::move(nodes).share()}};
}

Bvh joinLevels(const TwoLevels& levels, SharedArray<uint32_t> primitives) {
    const auto& [top, bottom] = levels;
    const size_t topSlots = top.nodes.size();
    Buffer<Node> nodes(topSlots + bottom.nodes.size());
    const auto moved = [&](Node node) {
        if (!node.isLeaf()) node.first += uint32_t(topSlots);
        return node;
    };
    for (size_t i = 0; i < topSlots; ++i) {
        const Node& node = top.nodes[i];
        nodes[i] = node.isLeaf() ? moved(bottom.roots[node.first]) : node;
        nodes[i].bounds = node.bounds;
    }
    for (size_t i = 0; i < bottom.nodes.size(); ++i) nodes[topSlots + i] = moved(bottom.nodes[i]);
    return {std::move(nodes).share(), std::move(primitives)};
}

}  // namespace bvhio
