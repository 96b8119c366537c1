#include "relayout/pair_tree.h"

#include <algorithm>

namespace bvhio {

PairTree::PairTree(const Bvh& bvh, const PairWeights& weights) {
    const auto& nodes = bvh.nodes;
    pairs.reserve(nodes.size() / 2 - 1);
    const PairWeights areas = weights.empty() ? weightsByArea(bvh) : PairWeights();
    const PairWeights& given = weights.empty() ? areas : weights;

    // Nodes whose children are still to be numbered, with the number of the pair that holds the node.
    struct Waiting {
        uint32_t node, parent, side;
    };
    std::array<Waiting, kMaxDepth + 2> stack{Waiting{0, kNone, 0}};
    size_t waiting = 1;
    while (waiting > 0) {
        const Waiting at = stack[--waiting];
        const Node& node = nodes[at.node];
        if (node.isLeaf()) continue;
        const auto number = uint32_t(pairs.size());
        pairs.push_back({node.left(), at.parent, {kNone, kNone}, 1, given[node.left() / 2]});
        if (at.parent != kNone) pairs[at.parent].children[at.side] = number;
        stack[waiting++] = {node.right(), number, 1};
        stack[waiting++] = {node.left(), number, 0};
    }
    for (size_t i = pairs.size(); i-- > 1;) pairs[pairs[i].parent].size += pairs[i].size;
}

std::vector<TreeItem> PairTree::items() const {
    std::vector<TreeItem> items(pairs.size());
    std::transform(pairs.begin(), pairs.end(), items.begin(), [](const Pair& pair) {
        return TreeItem{pair.weight, pair.children};
    });
    return items;
}

NodeOrder PairTree::nodeOrder(const std::vector<uint32_t>& numbers) const {
    NodeOrder order(numbers.size());
    std::transform(numbers.begin(), numbers.end(), order.begin(),
                   [&](uint32_t number) { return pairs[number].left; });
    return order;
}

}  // namespace bvhio
