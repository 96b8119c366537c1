// The surface area heuristic, as a builder's currency and as a tree's reported cost.
#pragma once

#include "tree/bvh.h"

namespace bvhio {

/// The two constants of the SAH (MacDonald and Booth 1990), in one arbitrary unit of time.
struct SahCosts {
    float traversal = 1.2f;     // visiting an inner node: both children's box tests
    float intersection = 1.0f;  // one ray-triangle test
    bool operator==(const SahCosts&) const = default;
};

/// The SAH cost of a tree: (traversal * sum of inner areas + intersection * sum of leaf areas * primitives) /
/// root area. When the root has no area (all geometry on one point or line), every area ratio counts as 1.
double sahCost(const Bvh& bvh, const SahCosts& costs);

}  // namespace bvhio
