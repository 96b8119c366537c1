// For forms whose leaves are small.
#pragma once

#include "compress/two_levels.h"

namespace bvhio {

/// The trees with no leaf of more than `maxSize` primitives: larger ones are halved, and their halves, each
/// within the same box. New pairs stand behind all others. Throws Error{unsupported} if that makes a tree too
/// deep.
Forest divideLeaves(const Forest& forest, uint32_t maxSize);
/// The same for one tree.
Bvh divideLeaves(const Bvh& bvh, uint32_t maxSize);

}  // namespace bvhio
