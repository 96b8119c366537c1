#include "tree/connected_parts.h"

#include <algorithm>
#include <limits>

namespace bvhio {

ConnectedParts::ConnectedParts(std::span<const TreeItem> items, uint32_t maxSize,
                               std::span<const uint32_t> within)
    : items_(items),
      within_(within),
      maxSize_(maxSize),
      mostItems_(items.size()),
      first_(items.size()),
      apart_(items.size()),
      bestSize_(items.size()) {
    size_t total = 0;
    for (size_t item = items.size(); item-- > 0;) {
        const auto [left, right] = items[item].children;
        mostItems_[item] = std::min(maxSize, 1 + mostItems(left) + mostItems(right));
        first_[item] = total;
        total += mostItems_[item];
    }
    costs_.assign(total, std::numeric_limits<double>::infinity());
    left_.resize(total);
    for (size_t item = items.size(); item-- > 0;) solve(uint32_t(item));
}

/// Returns the cost of a child's subtree, `size` items of which are in its parent's part.
double ConnectedParts::costOfShare(uint32_t child, uint32_t size) const {
    if (child == TreeItem::kNone) return 0;
    return size == 0 ? apart_[child] : cost(child, size);
}

/// Returns the most items that a child's subtree may add to its parent's part.
uint32_t ConnectedParts::mayJoin(uint32_t parent, uint32_t child) const {
    if (child == TreeItem::kNone || (!within_.empty() && within_[child] != within_[parent])) return 0;
    return std::min(mostItems(child), maxSize_ - 1);
}

void ConnectedParts::solve(uint32_t item) {
    const auto [left, right] = items_[item].children;
    double* costs = &costs_[first_[item]];
    const uint32_t mostLeft = mayJoin(item, left), mostRight = mayJoin(item, right);
    for (uint32_t i = 0; i <= mostLeft; ++i)
        for (uint32_t j = 0; j <= mostRight && i + j < maxSize_; ++j) {
            const double sum = costOfShare(left, i) + costOfShare(right, j);
            if (!(sum < costs[i + j])) continue;
            costs[i + j] = sum;
            left_[first_[item] + i + j] = uint16_t(i);
        }
    // Among equal costs, the largest part leaves the fewest lines.
    uint32_t best = 1;
    for (uint32_t size = 2; size <= mostItems_[item]; ++size)
        if (costs[size - 1] <= costs[best - 1]) best = size;
    bestSize_[item] = uint16_t(best);
    apart_[item] = costs[best - 1] + items_[item].weight;
}

std::vector<uint32_t> ConnectedParts::firstItems() const {
    std::vector<uint32_t> firstItems(items_.size());
    std::vector<uint32_t> parents(items_.size());
    // The number of items of the parent's part in each item's subtree. 0: the item starts a part.
    std::vector<uint16_t> joined(items_.size(), 0);
    for (uint32_t item = 0; item < items_.size(); ++item) {
        const bool starts = joined[item] == 0;
        firstItems[item] = starts ? item : firstItems[parents[item]];
        const uint32_t size = starts ? bestSize(item) : joined[item];
        const uint32_t onTheLeft = sizeOnTheLeft(item, size);
        const uint32_t shares[2] = {onTheLeft, size - 1 - onTheLeft};
        for (size_t side = 0; side < 2; ++side)
            if (const uint32_t child = items_[item].children[side]; child != TreeItem::kNone) {
                joined[child] = uint16_t(shares[side]);
                parents[child] = item;
            }
    }
    return firstItems;
}

}  // namespace bvhio
