// Divides a binary tree into connected parts that fit into a line, or a page, so that a walk from the root
// down enters as few parts as possible.
//
// Our own method, a dynamic program from the leaves up. For each item and each size it finds the least cost
// of the item's subtree if the item's part has that many items in this subtree. A child either joins its
// parent's part with some of its own subtree, or starts another part, which costs the child's weight.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bvhio {

/// An item of the tree that is divided. Items come after their parents.
struct TreeItem {
    static constexpr uint32_t kNone = 0xFFFFFFFF;

    double weight = 0;  // how often it is visited
    std::array<uint32_t, 2> children{kNone, kNone};
};

/// The division with the least sum of the weights of first items: how many parts a walk enters on average.
class ConnectedParts {
  public:
    /// Divides the tree into parts of at most `maxSize` items, 65535 at most. If `within` is given, it has an
    /// element for each item, equal for all items of a part. O(n maxSize). Refers to both spans.
    ConnectedParts(std::span<const TreeItem> items, uint32_t maxSize, std::span<const uint32_t> within = {});

    /// Returns for each item the first (topmost) item of its part.
    std::vector<uint32_t> firstItems() const;

    /// Returns the size of the best part that starts at the item; of equal costs, the largest.
    uint32_t bestSize(uint32_t item) const { return bestSize_[item]; }
    /// Returns the largest possible size of a part that starts at the item.
    uint32_t mostItems(uint32_t item) const { return item == TreeItem::kNone ? 0 : mostItems_[item]; }
    /// Returns how many of the part's `size` items, from this item down, go to the left subtree. The rest,
    /// minus this item, go to the right subtree.
    uint32_t sizeOnTheLeft(uint32_t item, uint32_t size) const { return left_[first_[item] + size - 1]; }
    /// Returns the cost of the item's subtree, without the item's own weight, if the part has `size` items in
    /// the subtree; infinity if that is impossible.
    double cost(uint32_t item, uint32_t size) const { return costs_[first_[item] + size - 1]; }

  private:
    double costOfShare(uint32_t child, uint32_t size) const;
    uint32_t mayJoin(uint32_t parent, uint32_t child) const;
    void solve(uint32_t item);

    std::span<const TreeItem> items_;
    std::span<const uint32_t> within_;
    uint32_t maxSize_;
    std::vector<uint32_t> mostItems_;
    std::vector<size_t> first_;  // of each item, in costs_ and left_: an element for each size from 1 on
    std::vector<double> costs_;
    std::vector<uint16_t> left_;
    std::vector<double> apart_;  // the cost if the item starts a part, with the item's weight
    std::vector<uint16_t> bestSize_;
};

}  // namespace bvhio
