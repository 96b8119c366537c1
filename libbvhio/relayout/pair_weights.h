// How often each sibling pair is fetched: what layouts weigh.
#pragma once

#include <span>
#include <vector>

#include "core/bvh.h"

namespace bvhio {

/// By half the index of the pair's left node; the first element, of the root and the unused slot, is not
/// used. No pair's is above that of the pair which holds its parent.
using PairWeights = std::vector<double>;

/// The probability that a random line which meets the root's box meets the parent's: the ratio of their
/// areas. 1 where the root has no area.
PairWeights weightsByArea(const Bvh& bvh);

}  // namespace bvhio
