// Builds the best tree over a few primitives.
#pragma once

#include "build/reference.h"
#include "tree/bvh.h"

namespace bvhio {

/// The rule for leaves: a range of at most maxLeafSize primitives becomes a leaf if the SAH cost is not
/// higher then.
struct LeafRule {
    float traversal, intersection;
    uint32_t maxLeafSize;

    /// Returns the SAH cost of a leaf, not divided by the root's area.
    float cost(float area, uint32_t count) const { return intersection * area * float(count); }
};

inline constexpr uint32_t kSmallTree = 4;

/// Builds the tree of least SAH cost over 1 to kSmallTree references. Writes its root to `node`, the pairs
/// below it, depth first, to `nodes` from `nodeCount` on (which it advances), and the primitives of its
/// leaves to `primitives` from `begin` on. Returns its cost.
float buildSmallTree(const Reference* references, uint32_t count, const LeafRule& rule, Node& node,
                     Node* nodes, uint32_t& nodeCount, uint32_t* primitives, uint32_t begin);

}  // namespace bvhio
