// Fits the boxes of a tree to primitives that have moved.
#pragma once

#include "tree/validate.h"

namespace bvhio {

/// Gives each leaf the smallest box around its primitives, and leaves inner nodes as they are.
void fitLeaves(std::span<Node> nodes, std::span<const uint32_t> primitives,
               const PrimitiveBounds& primitiveBounds);

/// Returns the same tree, where each box is the smallest one around its primitives. Leaves that hold parts of
/// triangles (by spatial splits) get boxes around the whole triangles.
Bvh refit(const Bvh& bvh, const PrimitiveBounds& primitiveBounds);

}  // namespace bvhio
