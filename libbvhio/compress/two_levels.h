// Cuts a canonical tree into a top level and many small trees, and joins them again.
#pragma once

#include "compress/forest.h"

namespace bvhio {

/// A tree in two levels. `top` has the nodes above the cut. Each of its leaves is a tree of `bottom`: first
/// is the tree's index, and primitiveCount is 1.
struct TwoLevels {
    Bvh top;
    Forest bottom;
};

/// Cuts off the largest subtrees of at most `maxSize` primitives, and larger leaves. Nodes of both levels
/// keep their order, and trees are in the order of their roots. O(n).
TwoLevels cutTree(const Bvh& bvh, uint32_t maxSize);

/// Joins both levels into a tree: the nodes of the top, followed by those of the bottom. Indices must be in
/// range, except for the primitives of leaves. Boxes may be anything.
Bvh joinLevels(const TwoLevels& levels, SharedArray<uint32_t> primitives);

}  // namespace bvhio
