// Fits a tree's boxes to primitives that moved.
#pragma once

#include "core/validate.h"

namespace bvhio {

/// The same tree, with each box the smallest around its primitives. Boxes of spatial splits grow to their
/// whole triangles.
Bvh refit(const Bvh& bvh, const PrimitiveBounds& primitiveBounds);

}  // namespace bvhio
