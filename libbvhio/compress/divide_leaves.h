// Divides leaves, for forms whose leaves are small.
#pragma once

#include "compress/forest.h"

namespace bvhio {

/// Returns the trees with leaves of at most `maxSize` primitives. Larger leaves are halved again and again,
/// and all parts have the leaf's box. New pairs come after all others. Throws Error{unsupported} if that
/// makes a tree too deep.
Forest divideLeaves(const Forest& forest, uint32_t maxSize);
/// Does the same for a single tree.
Bvh divideLeaves(const Bvh& bvh, uint32_t maxSize);

}  // namespace bvhio
