// Fits a tree's boxes to primitives that moved.
#pragma once

#include "tree/validate.h"

namespace bvhio {

/// Gives each leaf the smallest box around its primitives; other nodes stay as they are.
void fitLeaves(std::span<Node> nodes, std::span<const uint32_t> primitives,
               const PrimitiveBounds& primitiveBounds);

/// The same tree, with each box the smallest around its primitives. Boxes of spatial splits grow to their
/// whole triangles.
Bvh refit(const Bvh& bvh, const PrimitiveBounds& primitiveBounds);

}  // namespace bvhio
