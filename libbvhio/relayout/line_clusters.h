// Dividing a tree into connected clusters that fit into a line.
#pragma once

#include "relayout/pair_tree.h"

namespace bvhio {

/// More pairs than this a cluster can't have.
inline constexpr uint32_t kMaxClusterSize = 16;

/// Divides the tree into connected clusters of at most `maxSize` pairs, so that the weights of the clusters'
/// first pairs sum least: how many clusters a ray enters on average. Returns for each pair the first, which
/// is the topmost, of its cluster.
std::vector<uint32_t> lineClusters(const PairTree& tree, uint32_t maxSize);

}  // namespace bvhio
