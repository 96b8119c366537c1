// Small trees for tests, given by the pairs below their nodes.
#pragma once

#include <utility>
#include <vector>

#include "tree/bvh.h"

namespace bvhio::test {

/// Returns a tree: each entry is a node and the left node of the pair below it. All other nodes are leaves of
/// one primitive. All boxes are equal.
inline Bvh treeOfPairs(const std::vector<std::pair<uint32_t, uint32_t>>& pairs) {
    AlignedVector<Node> nodes(2 * pairs.size() + 2);
    std::vector<uint32_t> primitives;
    for (uint32_t i = 0; i < nodes.size(); ++i) nodes[i] = {{{0, 0, 0}, {1, 1, 1}}, 0, 1};
    nodes[1] = {};
    for (const auto& [node, left] : pairs) {
        nodes[node].first = left;
        nodes[node].primitiveCount = 0;
    }
    for (Node& node : nodes)
        if (node.isLeaf()) {
            node.first = uint32_t(primitives.size());
            primitives.push_back(node.first);
        }
    return {std::move(nodes), std::move(primitives)};
}

}  // namespace bvhio::test
