// From a tree in the making to a canonical one: nodes depth first, and leaves where they are cheaper.
#pragma once

#include <span>

#include "tree/sah_cost.h"

namespace bvhio {

/// A tree while a method makes or changes it. As Bvh, but pairs may stand anywhere, also before their
/// parents; those that no node has as children are ignored; and it may be deeper than kMaxDepth.
struct LooseTree {
    std::span<const Node> nodes;
    std::span<const uint32_t> primitives;
};

/// The canonical tree with the same nodes, depth first, and its primitives in that order. What would lie
/// deeper than kMaxDepth is balanced (tree/limit_depth.h). Parallel.
Bvh depthFirst(const LooseTree& tree);

/// The same, and subtrees of at most `maxLeafSize` triangles become leaves where that costs no more, bottom
/// up (Domingues and Pedrini 2015, 3.5). A triangle that spatial splits left several times in such a subtree
/// counts once, and is kept once. Leaves that the tree has stay, whatever their size.
Bvh collapse(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize);

/// The SAH cost that `collapse` would reach, without making the tree.
double collapsedCost(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize);

}  // namespace bvhio
