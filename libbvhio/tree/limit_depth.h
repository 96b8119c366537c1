// Limits the depth of trees, for methods that may exceed kMaxDepth.
#pragma once

#include <vector>

#include "tree/collapse.h"

namespace bvhio {

/// Returns the nodes of a tree whose depth is at most kMaxDepth, made from one that may be deeper. The
/// highest subtrees that could exceed the limit are rebuilt by halving their leaves, in depth-first order,
/// again and again. The rest stays.
std::vector<Node> limitDepth(std::span<const Node> nodes);

}  // namespace bvhio
