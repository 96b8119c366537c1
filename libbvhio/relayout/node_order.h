// An order of a tree's nodes in memory, and what puts a tree in that order.
#pragma once

#include <span>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// Siblings stay adjacent, so what a layout orders is sibling pairs, each named by the index of its left node
/// in the old tree. The root is not listed: it stays first. Every pair appears once, and behind the pair that
/// holds its parent.
using NodeOrder = std::vector<uint32_t>;

/// The same tree with its pairs in the given order: topology, boxes and the side of each child are kept.
/// Leaves own primitives in the order of a depth-first walk, left first, so that the primitives of any
/// subtree are one run; a leaf's primitives keep theirs. `order` must be as documented for NodeOrder.
Bvh applyNodeOrder(const Bvh& bvh, const NodeOrder& order);

/// What is known of each pair, by half the index of its left node, for the tree with its pairs in the given
/// order.
std::vector<uint32_t> inNodeOrder(std::span<const uint32_t> ofPairs, const NodeOrder& order);

}  // namespace bvhio
