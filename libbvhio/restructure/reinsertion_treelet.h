// A part of the tree that is small enough for the cache, in which several subtrees can move at once.
#pragma once

#include <vector>

#include "core/random.h"
#include "restructure/reinsertion_moves.h"

namespace bvhio {

/// The nodes from a root down to nodes that count as leaves here. Ruin and recreate (Schrimpf et al. 2000): a
/// step takes out a few subtrees near each other, and puts them back one by one, each at its cheapest place.
/// It is undone if it does not lower the sum of the inner nodes' areas. This finds trees that no single move
/// can reach.
class ReinsertionTreelet {
  public:
    /// Copies the tree below `root`, opening nodes of large area first, up to `maxLeaves` leaves.
    ReinsertionTreelet(const SubtreeMoves& moves, uint32_t root, uint32_t maxLeaves);

    uint32_t leaves() const { return leaves_; }
    /// Returns the slots of those leaves that have nodes of the tree below them.
    std::vector<uint32_t> openLeaves(const SubtreeMoves& moves) const;

    /// Takes steps, and returns how many of them lowered the sum.
    uint32_t improve(uint32_t steps, Random& random);

    /// Writes the treelet back into the tree that it was copied from, in the same slots.
    void write(SubtreeMoves& moves);

  private:
    static constexpr uint32_t kNone = ~0u;
    struct Part {
        Aabb box;
        uint32_t slot;
        double area;
        uint32_t parent = kNone, children[2] = {kNone, kNone};

        bool isLeaf() const { return children[0] == kNone; }
    };
    struct Visit {
        double grown;
        uint32_t part;
    };

    uint32_t add(const Node& node, uint32_t slot);
    uint32_t pick(Random& random) const;
    void pickMore(uint32_t first, Random& random);
    bool step(Random& random);
    bool isBelow(uint32_t part, uint32_t top) const;
    uint32_t sibling(uint32_t part) const;
    uint32_t takeOut(uint32_t part);
    void putBeside(uint32_t part, uint32_t beside);
    void refit(uint32_t part);
    uint32_t bestPlace(uint32_t part, double limit);

    const Aabb rootBox_;
    std::vector<Part> parts_;
    std::vector<uint32_t> pairs_, free_, taken_, siblings_;
    std::vector<Visit> open_;
    uint32_t leaves_ = 1, root_ = 0;
    double areas_ = 0;  // of the inner nodes
};

}  // namespace bvhio
