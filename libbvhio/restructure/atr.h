// Agglomerative treelet restructuring.
#pragma once

#include "restructure/treelets.h"

namespace bvhio {

/// Plans a tree over a treelet's leaves by joining nodes that are near each other.
bool planByAgglomeration(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& plan);

/// Rebuilds treelets by agglomeration (Domingues and Pedrini 2015). By default treelets have 9 leaves, and
/// there are 2 passes.
Restructured restructureAtr(const Scene& scene, const Bvh& bvh, const RestructureOptions& options);

}  // namespace bvhio
