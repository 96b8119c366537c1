// Moves of subtrees, judged by what they do to the cost of the tree with its leaves formed.
#pragma once

#include <array>

#include "core/buffer.h"
#include "restructure/tree_editor.h"

namespace bvhio {

/// Moves subtrees of a tree one by one where that lowers the cost that tree/collapse.h would reach. A node
/// with few enough references for a leaf counts with the cheaper of both, so it has its cost stored; of those
/// above, which stay inner nodes, only areas matter.
class SubtreeMoves {
  public:
    /// `touched` holds a flag for each slot: those get set for which a move opened new chances.
    SubtreeMoves(TreeEditor& tree, uint8_t* touched);

    /// Moves a subtree beside another node, as their new parent's children, if that lowers the cost.
    bool move(uint32_t moved, uint32_t beside);

    /// The references below a node, at most one more than a leaf may have; the cost of those that are few.
    struct Small {
        double cost;
        uint32_t count;
    };
    /// What stands in a slot.
    struct Content {
        Node node;
        Small small;
    };

    const TreeEditor& tree() const { return tree_; }
    /// Whether a node is a leaf, or would become one.
    bool isLeafInTheEnd(uint32_t slot) const;
    /// For who changes the tree beside: a slot's content; puts it elsewhere; makes an inner node over a pair,
    /// once its children are there.
    Content content(uint32_t slot) const { return {tree_[slot], small_[slot]}; }
    void put(uint32_t slot, const Content& content);
    void make(uint32_t slot, uint32_t pair, const Aabb& box);
    /// Brings nodes up to date, from one upwards until nothing changes.
    void update(uint32_t from);

    size_t bytes() const { return small_.size() * sizeof(Small); }

  private:
    /// A node as a move would make it, and by how much the cost below and including it would change, without
    /// the moved subtree if that is large.
    struct Changed {
        Aabb box;
        double delta;
        Small small;
    };
    /// Slots from a node up to the root.
    struct Path {
        std::array<uint32_t, 512> slots;
        uint32_t count = 0;
    };

    bool fewEnough(uint32_t count) const { return count <= maxLeafSize_; }
    uint32_t sumOf(uint32_t a, uint32_t b) const { return std::min(a + b, maxLeafSize_ + 1); }
    Small leaf(const Node& node) const;
    Small inner(const Aabb& box, const Small& left, const Small& right) const;
    bool climb(uint32_t from, Path& path) const;
    double change(uint32_t moved, uint32_t beside);
    Changed withoutMoved(uint32_t moved) const;
    Changed withMoved(uint32_t moved, uint32_t beside) const;
    Changed above(uint32_t child, const Changed& below, const Aabb& box) const;
    void apply(uint32_t moved, uint32_t beside);
    void touch(uint32_t slot);

    TreeEditor& tree_;
    uint8_t* const touched_;
    const double traversal_, intersection_;
    const uint32_t maxLeafSize_;  // 0 when no leaves form
    Buffer<Small> small_;
    Path movedPath_, besidePath_;
};

}  // namespace bvhio
