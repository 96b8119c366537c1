// Checks every invariant that tree/bvh.h lists.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/findings.h"
#include "tree/bvh.h"

namespace bvhio {

/// Writes the box of each primitive, given by indices below the primitive count. In batches, so that an
/// implementation can fetch the data of later ones ahead: they lie scattered.
using PrimitiveBounds = std::function<void(std::span<const uint32_t> primitives, Aabb* boxes)>;

struct Validation {
    std::vector<Finding> findings;  // 30xx and 40xx, by kind, then node; the same for any number of threads
    uint32_t depth = 0;             // edges from the root to the deepest leaf; 0 when the structure is broken
};

/// Checks a tree that may be anything at all: no index is trusted. Parallel, O(n), and fast enough to run at
/// every load. After `maxPerId` findings of one kind the rest of that kind is left out.
///
/// With a triangle in several leaves (references > primitiveCount), invariant 4 is checked as far as boxes
/// go: each of the triangle's leaf boxes touches the triangle's box, and together their hull contains it.
Validation validate(const Bvh& bvh, uint32_t primitiveCount, const PrimitiveBounds& primitiveBounds,
                    size_t maxPerId = 8);

}  // namespace bvhio
