#pragma once

#include "restructure/treelets.h"

namespace bvhio {

/// The time for a treelet of n leaves grows as 3 to the power of n.
inline constexpr uint32_t kLargestOptimalTreelet = 12;

/// Plans the tree of least cost over a treelet's leaves.
bool planOptimally(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& plan);

/// Makes treelets optimal by dynamic programming (Karras and Aila 2013); by default of 7 leaves, in 3 passes.
Restructured restructureTr(const Scene& scene, const Bvh& bvh, const RestructureOptions& options);

}  // namespace bvhio
