// Dividing a binary tree into connected parts that fit into a line, or a page, so that a walk from the root
// down enters as few as possible.
//
// Ours; a dynamic program from the leaves up: for each item and each size, the least cost of its subtree
// where the item's part has so many items from it on down. A child joins the part with some of its own
// subtree, or starts another part and costs its weight.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bvhio {

/// What is divided: items that come behind their parents.
struct TreeItem {
    static constexpr uint32_t kNone = 0xFFFFFFFF;

    double weight = 0;  // how often it is visited
    std::array<uint32_t, 2> children{kNone, kNone};
};

/// The division whose parts' first items weigh least together: how many parts a walk enters on average.
class ConnectedParts {
  public:
    /// Parts have at most `maxSize` items, 65535 at most. Where `within` has an element for each item, no
    /// part holds items of two. O(n maxSize). Refers to both.
    ConnectedParts(std::span<const TreeItem> items, uint32_t maxSize, std::span<const uint32_t> within = {});

    /// For each item the first one, which is the topmost, of its part.
    std::vector<uint32_t> firstItems() const;

    /// How large the part is that starts at an item where one does: of equal costs the largest.
    uint32_t bestSize(uint32_t item) const { return bestSize_[item]; }
    /// How large it could be.
    uint32_t mostItems(uint32_t item) const { return item == TreeItem::kNone ? 0 : mostItems_[item]; }
    /// Of `size` items from this one on down, how many are below its left child, and that child's; the others
    /// but this one are below its right child.
    uint32_t sizeOnTheLeft(uint32_t item, uint32_t size) const { return left_[first_[item] + size - 1]; }
    /// What the subtree costs, without the item's own weight, where the part has `size` items from it on
    /// down; infinite where it can't.
    double cost(uint32_t item, uint32_t size) const { return costs_[first_[item] + size - 1]; }

  private:
    double costOfShare(uint32_t child, uint32_t size) const;
    uint32_t mayJoin(uint32_t parent, uint32_t child) const;
    void solve(uint32_t item);

    std::span<const TreeItem> items_;
    std::span<const uint32_t> within_;
    uint32_t maxSize_;
    std::vector<uint32_t> mostItems_;
    std::vector<size_t> first_;  // of each item, in costs_ and left_: one element for each size from 1 on
    std::vector<double> costs_;
    std::vector<uint16_t> left_;
    std::vector<double> apart_;  // the cost where the item starts a part, its weight included
    std::vector<uint16_t> bestSize_;
};

}  // namespace bvhio
