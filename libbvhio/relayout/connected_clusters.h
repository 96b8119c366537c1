// Dividing a tree into connected clusters that fit into a line, or a page.
#pragma once

#include "relayout/pair_tree.h"

namespace bvhio {

/// Divides the tree into connected clusters of at most `maxSize` pairs, 65535 at most, so that the weights of
/// the clusters' first pairs sum least: how many clusters a ray enters on average. Returns for each pair the
/// first, which is the topmost, of its cluster. With `within`, the result of another call, no cluster is in
/// two of those. O(n * maxSize).
std::vector<uint32_t> connectedClusters(const PairTree& tree, uint32_t maxSize,
                                        const std::vector<uint32_t>& within = {});

}  // namespace bvhio
