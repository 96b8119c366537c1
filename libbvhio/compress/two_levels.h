// A canonical tree cut into a top level and many small trees, and joined again.
#pragma once

#include "tree/bvh.h"

namespace bvhio {

/// Many trees over one array of primitives, whose nodes below the roots share one array: sibling pairs at
/// even indices, behind their parents. Inner nodes, roots among them, name their left child in `nodes`.
struct Forest {
    SharedArray<Node> roots, nodes;
};

/// The nodes of `top` above the cut; its leaves have a tree of `bottom` each: first is its index, and
/// primitiveCount is 1.
struct TwoLevels {
    Bvh top;
    Forest bottom;
};

/// Cuts off the largest subtrees of at most `maxSize` primitives, and larger leaves. O(n). Nodes of both
/// levels keep their order; trees are in the order of their roots.
TwoLevels cutTree(const Bvh& bvh, uint32_t maxSize);

/// The tree that both levels make: the top's nodes, the bottom's behind them. What `levels` names may be out
/// of range only where a leaf owns primitives; boxes may be anything.
Bvh joinLevels(const TwoLevels& levels, SharedArray<uint32_t> primitives);

}  // namespace bvhio
