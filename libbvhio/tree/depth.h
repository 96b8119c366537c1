// The depth of nodes, in edges from the root.
#pragma once

#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// Returns the depth of each pair of siblings, by half the index of its left node; element 0 is the root's.
/// Children must come after their parents, but the tree may be deeper than kMaxDepth.
std::vector<uint32_t> depthsOfPairs(const Bvh& bvh);

/// Returns the depth of the deepest leaf.
uint32_t depthOf(const Bvh& bvh);

}  // namespace bvhio
