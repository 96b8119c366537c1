// S.-E. Yoon, D. Manocha, "Cache-Efficient Layouts of Bounding Volume Hierarchies", Eurographics 2006: of n
// pairs about the square root of n that are likeliest to be fetched, connected to the root, come first; then
// each subtree that is left, the likeliest first. All of these are divided in the same way, so that pairs
// which are fetched together are close at any scale, whatever the size of a line.
//
// Departure: child clusters follow by their weight; the paper orders them by where they lie in space.

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
