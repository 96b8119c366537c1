// Treelet restructuring by dynamic programming.
#pragma once

#include "restructure/treelets.h"

namespace bvhio {

/// The time for a treelet of n leaves grows with 3 to the power of n.
inline constexpr uint32_t kLargestOptimalTreelet = 12;

/// Plans the tree of least cost over a treelet's leaves.
bool planOptimally(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& plan);

/// Makes treelets optimal by dynamic programming (Karras and Aila 2013). By default treelets have 7 leaves,
/// and there are 3 passes.
Restructured restructureTr(const Scene& scene, const Bvh& bvh, const RestructureOptions& options);

}  // namespace bvhio
