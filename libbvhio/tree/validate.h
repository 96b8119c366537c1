// Checks every invariant that tree/bvh.h lists.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/findings.h"
#include "tree/bvh.h"

namespace bvhio {

/// Writes the box of each primitive of a batch; the indices are below the primitive count. A batch lets the
/// function prefetch the data of later primitives, which lie scattered in memory.
using PrimitiveBounds = std::function<void(std::span<const uint32_t> primitives, Aabb* boxes)>;

struct Validation {
    std::vector<Finding> findings;  // 30xx and 40xx, by kind, then node; the same for any number of threads
    uint32_t depth = 0;             // edges from the root to the deepest leaf; 0 if the structure is broken
};

/// Checks a tree without trusting any of its indices. Parallel, O(n), and fast enough to run at every load.
/// Reports at most `maxPerId` findings of one kind.
///
/// If triangles are in several leaves (references > primitiveCount), invariant 4 is checked only by boxes:
/// each leaf box of a triangle must touch the triangle's box, and their hull must contain the triangle's box.
Validation validate(const Bvh& bvh, uint32_t primitiveCount, const PrimitiveBounds& primitiveBounds,
                    size_t maxPerId = 8);

}  // namespace bvhio
