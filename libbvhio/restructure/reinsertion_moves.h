// Moves of subtrees, judged by the cost of the tree after its leaves are formed.
#pragma once

#include <array>

#include "core/buffer.h"
#include "restructure/tree_editor.h"

namespace bvhio {

/// Moves subtrees of a tree one by one, if that lowers the cost that tree/collapse.h would reach. A node with
/// few enough references for a leaf counts as a leaf or as an inner node, whichever is cheaper, so its cost
/// is stored. Nodes with more references stay inner nodes, and only their areas matter.
class SubtreeMoves {
  public:
    /// `touched` has a flag for each slot. A move sets the flags of slots that may find better places now.
    SubtreeMoves(TreeEditor& tree, uint8_t* touched);

    /// Moves a subtree next to another node if that lowers the cost. A new parent gets the two as children.
    /// Returns whether it moved.
    bool move(uint32_t moved, uint32_t beside);

    /// The number of references below a node, limited to one more than a leaf may have, and the cost if a
    /// leaf may have that many.
    struct Small {
        double cost;
        uint32_t count;
    };
    /// The content of a slot.
    struct Content {
        Node node;
        Small small;
    };

    const TreeEditor& tree() const { return tree_; }
    /// Returns whether a node is a leaf, or would become a leaf.
    bool becomesLeaf(uint32_t slot) const;
    /// The following functions are for code that changes the tree itself. Returns the content of a slot.
    Content content(uint32_t slot) const { return {tree_[slot], small_[slot]}; }
    /// Puts a content into a slot.
    void put(uint32_t slot, const Content& content);
    /// Makes an inner node over a pair whose nodes are in place.
    void make(uint32_t slot, uint32_t pair, const Aabb& box);
    /// Updates nodes from one upwards, until nothing changes.
    void update(uint32_t from);

    size_t bytes() const { return small_.size() * sizeof(Small); }

  private:
    /// A node after a move, and the change of its subtree's cost. The cost of the moved subtree counts only
    /// if it is small.
    struct Changed {
        Aabb box;
        double delta;
        Small small;
    };
    /// The slots from a node up to the root.
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
    const uint32_t maxLeafSize_;  // 0 if no leaves form
    Buffer<Small> small_;
    Path movedPath_, besidePath_;
};

}  // namespace bvhio
