// Ordered depth-first: like dfs, but of two subtrees the one that is entered more often comes first, so that
// it directly follows its parent. D. Wodniok, A. Schulz, S. Widmer, M. Goesele, "Analysis of Cache Behavior
// and Performance of Different BVH Memory Layouts for Tracing Incoherent Rays", EGPGV 2013, call this ODFS
// and, with visits counted in an earlier run, SWST.
//
// Departure: siblings stay a pair and keep their sides, so that only their subtrees are swapped. This makes
// ODFS and SWST the same order with different weights.

#include "relayout/odfs.h"

#include "relayout/pair_tree.h"

namespace bvhio {

LayoutResult layoutOdfs(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    std::vector<uint32_t> order;
    order.reserve(tree.size());
    std::array<uint32_t, kMaxDepth + 1> stack{0};
    size_t waiting = tree.size() == 0 ? 0 : 1;
    while (waiting > 0) {
        const uint32_t pair = stack[--waiting];
        order.push_back(pair);
        std::array<uint32_t, 2> children;
        for (uint32_t i = tree.children(pair, true, children); i-- > 0;) stack[waiting++] = children[i];
    }
    return {tree.nodeOrder(order)};
}

}  // namespace bvhio
