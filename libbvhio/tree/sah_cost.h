// The surface area heuristic (SAH): the cost that builders minimise and that reports show.
#pragma once

#include "tree/bvh.h"

namespace bvhio {

/// The two constants of the SAH (MacDonald and Booth 1990), in one arbitrary unit of time.
struct SahCosts {
    float traversal = 1.2f;     // visiting an inner node: both children's box tests
    float intersection = 1.0f;  // one ray-triangle test
    bool operator==(const SahCosts&) const = default;
};

/// Returns the SAH cost: (traversal * sum of inner areas + intersection * sum of (leaf area * primitives)) /
/// root area. If the root has no area (all geometry on one point or line), every ratio of areas counts as 1.
double sahCost(const Bvh& bvh, const SahCosts& costs);

}  // namespace bvhio
