// Random legal rearrangements of a tree, like those by layouts, for tests of properties that layouts must
// keep.
#pragma once

#include <algorithm>

#include "core/random.h"
#include "tree/bvh.h"

namespace bvhio::test {

/// Returns the same tree with its sibling pairs in another order (parents still before children), half of all
/// siblings swapped, and the triangles of each leaf shuffled. Without swapChildren, only the order of pairs
/// changes.
inline Bvh shuffledTree(const Bvh& bvh, uint64_t seed, bool swapChildren = true) {
    Random random(seed);
    AlignedVector<Node> nodes(bvh.nodes.size());
    std::vector<uint32_t> primitives(bvh.primitives.begin(), bvh.primitives.end());
    nodes[0] = bvh.nodes[0];
    nodes[1] = Node{};
    std::vector<uint32_t> open;  // placed inner nodes whose children are not placed yet
    if (!nodes[0].isLeaf()) open.push_back(0);
    for (uint32_t next = 2; !open.empty(); next += 2) {
        std::swap(open[random.below(uint32_t(open.size()))], open.back());
        Node& parent = nodes[open.back()];
        open.pop_back();
        nodes[next] = bvh.nodes[parent.left()];
        nodes[next + 1] = bvh.nodes[parent.right()];
        parent.first = next;
        if (swapChildren && random.below(2) == 1) std::swap(nodes[next], nodes[next + 1]);
        for (const uint32_t child : {next, next + 1})
            if (!nodes[child].isLeaf()) open.push_back(child);
    }
    if (swapChildren)
        for (const Node& node : nodes)
            for (uint32_t i = node.primitiveCount; i > 1; --i)
                std::swap(primitives[node.first + i - 1], primitives[node.first + random.below(i)]);
    return {std::move(nodes), std::move(primitives)};
}

}  // namespace bvhio::test
