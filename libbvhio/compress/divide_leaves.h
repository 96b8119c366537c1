// For forms whose leaves are small.
#pragma once

#include "core/bvh.h"

namespace bvhio {

/// The tree with no leaf of more than `maxSize` primitives: larger ones are halved, and their halves, each
/// within the same box. New pairs stand behind all others. Throws Error{unsupported} if that makes the tree
/// too deep.
Bvh divideLeaves(const Bvh& bvh, uint32_t maxSize);

}  // namespace bvhio
