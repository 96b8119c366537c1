#include "compress/divide_leaves.h"

#include <algorithm>

#include "core/error.h"

namespace bvhio {

Forest divideLeaves(const Forest& forest, uint32_t maxSize) {
    const auto isLarge = [&](const Node& node) { return node.primitiveCount > maxSize; };
    if (std::none_of(forest.roots.begin(), forest.roots.end(), isLarge) &&
        std::none_of(forest.nodes.begin(), forest.nodes.end(), isLarge))
        return forest;
    AlignedVector<Node> roots(forest.roots.begin(), forest.roots.end());
    AlignedVector<Node> nodes(forest.nodes.begin(), forest.nodes.end());
    std::vector<uint8_t> depths(nodes.size() / 2);  // of the nodes of a pair
    const auto divided = [&](const Node node, uint32_t depth) -> Node {
        if (node.isLeaf() && !isLarge(node)) return node;
        if (depth == kMaxDepth)
            throw Error(ErrorKind::unsupported, "leaves of more than " + std::to_string(maxSize) +
                                                    " triangles are too deep to be divided: use another "
                                                    "--form, or build with a smaller --max-leaf-size");
        if (!node.isLeaf()) {
            depths[node.left() / 2] = uint8_t(depth + 1);
            return node;
        }
        const auto pair = uint32_t(nodes.size());
        const uint32_t half = node.primitiveCount / 2;
        nodes.push_back({node.bounds, node.first, half});
        nodes.push_back({node.bounds, node.first + half, node.primitiveCount - half});
        depths.push_back(uint8_t(depth + 1));
        return {node.bounds, pair, 0};
    };
    for (Node& root : roots) root = divided(root, 0);
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].isLeaf() && nodes[i].left() <= i) continue;  // the unused slot beside a Bvh's root
        const Node node = divided(nodes[i], depths[i / 2]);        // `nodes` may grow
        nodes[i] = node;
    }
    return {std::move(roots), std::move(nodes)};
}

Bvh divideLeaves(const Bvh& bvh, uint32_t maxSize) {
    return {divideLeaves(Forest{{}, bvh.nodes}, maxSize).nodes, bvh.primitives};
}

}  // namespace bvhio
