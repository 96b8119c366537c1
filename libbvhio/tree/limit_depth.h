// The bound on depth, for methods that do not keep it by themselves.
#pragma once

#include <vector>

#include "tree/collapse.h"

namespace bvhio {

/// The nodes of a tree that may be deeper than kMaxDepth, changed so that it is not: the highest subtrees
/// that could exceed it are halved, over their leaves in depth-first order, down to these. The rest stays.
std::vector<Node> limitDepth(std::span<const Node> nodes);

}  // namespace bvhio
