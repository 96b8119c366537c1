// Turns a tree in the making into a canonical one: nodes depth first, and leaves where they are cheaper.
#pragma once

#include <span>

#include "tree/sah_cost.h"

namespace bvhio {

/// A tree while a method makes or changes it. Unlike in Bvh, pairs may be anywhere, even before their
/// parents; pairs that are not the children of a node are ignored; and the tree may be deeper than kMaxDepth.
struct LooseTree {
    std::span<const Node> nodes;
    std::span<const uint32_t> primitives;
};

/// Returns the canonical tree with the same nodes in depth-first order, and the primitives in that order.
/// Subtrees that would exceed kMaxDepth are balanced (tree/limit_depth.h). Parallel.
Bvh depthFirst(const LooseTree& tree);

/// Does the same, and turns subtrees of at most `maxLeafSize` triangles into leaves where that costs no more,
/// bottom up (Domingues and Pedrini 2015, 3.5). A triangle with several references in such a subtree, by
/// spatial splits, counts once and is kept once. Existing leaves stay, whatever their size.
Bvh collapse(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize);

/// Returns the SAH cost that `collapse` would reach, without making the tree.
double collapsedCost(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize);

}  // namespace bvhio
