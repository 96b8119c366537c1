// The weights by which layouts decide: how often each sibling pair is fetched.
#pragma once

#include <span>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// Weights by half the index of each pair's left node. The first element, for the root and the unused slot,
/// is not used. A pair's weight is at most that of the pair that holds its parent.
using PairWeights = std::vector<double>;

/// Returns the probability that a random line that meets the root's box also meets the box of a pair's
/// parent: the ratio of their areas. All are 1 if the root has no area.
PairWeights weightsByArea(const Bvh& bvh);

/// Returns the visits of a tree's pairs, which were counted over visits[0] rays, plus `smoothing` times the
/// visits that as many random lines through the root's box would make, so that views that were not recorded
/// matter too. A small minimum of smoothing is always applied: it only decides between pairs that no ray
/// visited.
PairWeights weightsByVisits(const Bvh& bvh, std::span<const uint32_t> visits, float smoothing);

}  // namespace bvhio
