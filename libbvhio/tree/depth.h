// How deep nodes lie, in edges from the root.
#pragma once

#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// The depth of each pair of siblings, by half the index of its left node, in a tree whose children lie
/// behind their parents; it may be deeper than kMaxDepth. The root has the first.
std::vector<uint32_t> depthsOfPairs(const Bvh& bvh);

/// The depth of the deepest leaf.
uint32_t depthOf(const Bvh& bvh);

}  // namespace bvhio
