// SAH with spatial splits (SBVH), which may cut a triangle into parts for several nodes.
#pragma once

#include "build/builders.h"

namespace bvhio {

inline constexpr float kMaxSplitBudget = 16;

/// Builds a tree with at most options.splitBudget extra references per triangle. Throws Error{usage} if
/// options.bins is 1 or above kMaxBins, or options.splitBudget is not from 0 to kMaxSplitBudget.
Bvh buildSpatial(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
