#include "compress/divide_leaves.h"

#include <algorithm>

#include "core/error.h"

namespace bvhio {

Bvh divideLeaves(const Bvh& bvh, uint32_t maxSize) {
    const auto isLarge = [&](const Node& node) { return node.primitiveCount > maxSize; };
    if (std::none_of(bvh.nodes.begin(), bvh.nodes.end(), isLarge)) return bvh;
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    std::vector<uint8_t> depths(nodes.size() / 2);  // of the nodes of a pair
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Node node = nodes[i];
        if (i == 1 || (node.isLeaf() && !isLarge(node))) continue;
        const auto depth = uint8_t(depths[i / 2] + 1);
        if (depth > kMaxDepth)
            throw Error(ErrorKind::unsupported, "leaves of more than " + std::to_string(maxSize) +
                                                    " triangles lie too deep to be divided: use another "
                                                    "--form, or build with a smaller --max-leaf-size");
        if (!node.isLeaf()) {
            depths[node.left() / 2] = depth;
            continue;
        }
        const auto pair = uint32_t(nodes.size());
        const uint32_t half = node.primitiveCount / 2;
        nodes.push_back({node.bounds, node.first, half});
        nodes.push_back({node.bounds, node.first + half, node.primitiveCount - half});
        depths.push_back(depth);
        nodes[i] = {node.bounds, pair, 0};
    }
    return {std::move(nodes), bvh.primitives};
}

}  // namespace bvhio
