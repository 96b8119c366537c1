// S.-E. Yoon, D. Manocha, "Cache-Efficient Layouts of Bounding Volume Hierarchies", Eurographics 2006. Of n
// pairs, a top of about sqrt(n) pairs comes first: the pairs that are most likely to be fetched and are
// connected to the root. Then come the subtrees below it, the likeliest first. The top and each subtree are
// divided in the same way again, so that pairs which are fetched together are close together at any scale,
// for any size of a line.
//
// Departure: child clusters are ordered by weight. The paper orders them by their position in space.

#include "relayout/col.h"

#include <cmath>
#include <numeric>
#include <queue>

#include "relayout/recursive_order.h"

namespace bvhio {
namespace {

struct CutByWeight {
    const PairTree& tree;

    std::vector<uint32_t> top(std::span<const uint32_t> members) const {
        const auto isLess = [&](uint32_t a, uint32_t b) {
            return isBefore(b, a) || (!isBefore(a, b) && b < a);
        };
        std::priority_queue<uint32_t, std::vector<uint32_t>, decltype(isLess)> frontier(isLess);
        std::vector<uint32_t> found;
        const auto count = std::max<size_t>(1, size_t(std::ceil(std::sqrt(double(members.size()) + 1) - 1)));
        for (frontier.push(members[0]); found.size() < count && !frontier.empty();) {
            const uint32_t pair = frontier.top();
            frontier.pop();
            found.push_back(pair);
            for (const uint32_t child : tree[pair].children)
                if (child != PairTree::kNone && std::binary_search(members.begin(), members.end(), child))
                    frontier.push(child);
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    bool isBefore(uint32_t a, uint32_t b) const { return tree[a].weight > tree[b].weight; }
};

}  // namespace

LayoutResult layoutCol(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    std::vector<uint32_t> members(tree.size()), order;
    std::iota(members.begin(), members.end(), 0u);
    order.reserve(tree.size());
    orderRecursively(tree, std::span<const uint32_t>(members), CutByWeight{tree}, order);
    return {tree.nodeOrder(order)};
}

}  // namespace bvhio
