// Depth-first order, the common layout with which others are compared: a pair of siblings, then all pairs
// below the left sibling, then all pairs below the right one. The first pair below a left child directly
// follows the child's pair.

#include "relayout/dfs.h"

#include <array>

namespace bvhio {

LayoutResult layoutDfs(const Bvh& bvh, const LayoutOptions&) {
    NodeOrder order;
    order.reserve(bvh.nodes.size() / 2 - 1);
    std::array<uint32_t, kMaxDepth + 2> stack{0};  // nodes whose subtrees are still to be placed
    size_t waiting = 1;
    while (waiting > 0) {
        const Node& node = bvh.nodes[stack[--waiting]];
        if (node.isLeaf()) continue;
        order.push_back(node.left());
        stack[waiting++] = node.right();
        stack[waiting++] = node.left();
    }
    return {std::move(order)};
}

}  // namespace bvhio
