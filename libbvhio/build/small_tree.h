// The best tree over a handful of primitives.
#pragma once

#include "build/reference.h"
#include "tree/bvh.h"

namespace bvhio {

/// When a range of primitives is a leaf: at most maxLeafSize of them, and the SAH is no higher for it.
struct LeafRule {
    float traversal, intersection;
    uint32_t maxLeafSize;

    /// A leaf's SAH cost, not divided by the root's area.
    float cost(float area, uint32_t count) const { return intersection * area * float(count); }
};

inline constexpr uint32_t kSmallTree = 4;

/// Writes the tree of least SAH cost over 1 to kSmallTree references: its root to `node`, the pairs below to
/// `nodes` from `nodeCount` on (which it advances), depth first, and the primitives of its leaves to
/// `primitives` from `begin` on. Returns its cost.
float buildSmallTree(const Reference* references, uint32_t count, const LeafRule& rule, Node& node,
                     Node* nodes, uint32_t& nodeCount, uint32_t* primitives, uint32_t begin);

}  // namespace bvhio
