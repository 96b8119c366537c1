// Orders of a tree's nodes in memory, and functions that apply them.
#pragma once

#include <span>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// An order of sibling pairs, since siblings stay adjacent. Each pair is given by the index of its left node
/// in the old tree. The root is not listed, since it stays first. Every pair appears once, and after the pair
/// that holds its parent.
using NodeOrder = std::vector<uint32_t>;

/// Returns the same tree with its pairs in the given order. The topology, the boxes and the side of each
/// child stay the same. The ranges of leaves follow a depth-first walk, left first, so that the primitives of
/// any subtree are one run; the order within a leaf stays the same. `order` must be valid, as described at
/// NodeOrder.
Bvh applyNodeOrder(const Bvh& bvh, const NodeOrder& order);

/// Returns values of pairs, which are given by half the index of each pair's left node, for the tree with its
/// pairs in the given order.
std::vector<uint32_t> inNodeOrder(std::span<const uint32_t> ofPairs, const NodeOrder& order);

}  // namespace bvhio
