// The trees of a forest, together and apart.
#pragma once

#include <optional>
#include <vector>

#include "compress/two_levels.h"

namespace bvhio {

/// Trees that lie one behind the other: the pairs of each in one stretch of Forest::nodes, and the entries of
/// its leaves in one stretch of the primitives.
struct SeparateTrees {
    std::vector<Bvh> trees;            // with the unused slot, and primitives of their own
    std::vector<uint32_t> firstSlots;  // where the pairs of each start in Forest::nodes
};

/// Nothing when the trees do not lie so. Indices of leaves' entries may be anything; children must lie behind
/// their parents, and all of them in range.
std::optional<SeparateTrees> separateTrees(const Forest& forest, std::span<const uint32_t> primitives);

/// The same the other way: valid trees behind each other, and their primitives.
struct GatheredTrees {
    Forest forest;
    SharedArray<uint32_t> primitives;
};
GatheredTrees gatherTrees(std::span<const Bvh> trees);

}  // namespace bvhio
