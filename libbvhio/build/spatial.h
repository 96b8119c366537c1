// SAH with spatial splits (SBVH): triangles may be cut between nodes.
#pragma once

#include "build/builders.h"

namespace bvhio {

inline constexpr float kMaxSplitBudget = 16;

/// The tree has at most options.splitBudget more references than triangles, per triangle. Throws Error{usage}
/// when options.bins is 1 or above kMaxBins, or options.splitBudget is not from 0 to kMaxSplitBudget.
Bvh buildSpatial(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
