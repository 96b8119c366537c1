// Breadth-first order: level by level, the pairs of each level from left to right. The upper levels, which
// many rays read, are close together, but further down a pair is far from its parent.

#include "relayout/bfs.h"

namespace bvhio {

LayoutResult layoutBfs(const Bvh& bvh, const LayoutOptions&) {
    NodeOrder order;
    order.reserve(bvh.nodes.size() / 2 - 1);
    if (!bvh.nodes[0].isLeaf()) order.push_back(bvh.nodes[0].left());
    for (size_t next = 0; next < order.size(); ++next)
        for (const uint32_t node : {order[next], order[next] + 1})
            if (!bvh.nodes[node].isLeaf()) order.push_back(bvh.nodes[node].left());
    return {std::move(order)};
}

}  // namespace bvhio
