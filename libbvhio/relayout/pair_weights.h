// How often each sibling pair is fetched: what layouts weigh.
#pragma once

#include <span>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// By half the index of the pair's left node; the first element, of the root and the unused slot, is not
/// used. No pair's is above that of the pair which holds its parent.
using PairWeights = std::vector<double>;

/// The probability that a random line which meets the root's box meets the parent's: the ratio of their
/// areas. 1 where the root has no area.
PairWeights weightsByArea(const Bvh& bvh);

/// Visits of a tree's pairs, which were counted over visits[0] rays, and `smoothing` times as many as random
/// lines that meet the root's box would make: a view that was not recorded is not forgotten. At the least so
/// few that they only decide between pairs which no ray visited.
PairWeights weightsByVisits(const Bvh& bvh, std::span<const uint32_t> visits, float smoothing);

}  // namespace bvhio
