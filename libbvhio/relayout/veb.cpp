// The layout of P. van Emde Boas' trees. The tree is cut at half its height. The top comes first, then each
// subtree below it, from left to right, and all of these are cut again. H. Prokop, "Cache-Oblivious
// Algorithms", 1999: for any size of a line, any way down reads few lines. The layout does not use
// probabilities.
//
// Departure: our trees are not balanced, so each subtree is cut at half its own height.

#include "relayout/veb.h"

#include <numeric>

#include "relayout/recursive_order.h"

namespace bvhio {
namespace {

struct CutAtHalfHeight {
    const PairTree& tree;
    std::vector<uint32_t> depths;

    explicit CutAtHalfHeight(const PairTree& pairs) : tree(pairs), depths(pairs.size(), 0) {
        for (uint32_t pair = 1; pair < tree.size(); ++pair) depths[pair] = depths[tree[pair].parent] + 1;
    }

    std::vector<uint32_t> top(std::span<const uint32_t> members) const {
        uint32_t deepest = 0;
        for (const uint32_t pair : members) deepest = std::max(deepest, depths[pair]);
        const uint32_t root = depths[members[0]], height = deepest - root + 1;
        std::vector<uint32_t> found;
        for (const uint32_t pair : members)
            if (depths[pair] - root < height / 2) found.push_back(pair);
        return found;
    }
    bool isBefore(uint32_t, uint32_t) const { return false; }  // subtrees stay in order, from left to right
};

}  // namespace

LayoutResult layoutVeb(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    std::vector<uint32_t> members(tree.size()), order;
    std::iota(members.begin(), members.end(), 0u);
    order.reserve(tree.size());
    orderRecursively(tree, std::span<const uint32_t>(members), CutAtHalfHeight(tree), order);
    return {tree.nodeOrder(order)};
}

}  // namespace bvhio
