// Separates the trees of a forest, and gathers trees into one.
#pragma once

#include <optional>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// Many trees over one array of primitives. Their nodes below the roots share one array: sibling pairs at
/// even indices, after their parents. `first` of an inner node, also of a root, is the index of its left
/// child in `nodes`.
struct Forest {
    SharedArray<Node> roots, nodes;
};

/// The trees of a forest in which the trees follow one another: the pairs of each tree are a run of
/// Forest::nodes, and the entries of its leaves a run of the primitives.
struct SeparateTrees {
    std::vector<Bvh> trees;            // with the unused slot, and with their own primitives
    std::vector<uint32_t> firstSlots;  // the start of each tree's pairs in Forest::nodes
};

/// Separates the trees of a forest. Returns nothing if the trees do not follow one another. The ranges of
/// leaves may be anything, but children must come after their parents and be in range.
std::optional<SeparateTrees> separateTrees(const Forest& forest, std::span<const uint32_t> primitives);

/// Valid trees, one after another in a forest, and their primitives.
struct GatheredTrees {
    Forest forest;
    SharedArray<uint32_t> primitives;
};
GatheredTrees gatherTrees(std::span<const Bvh> trees);

}  // namespace bvhio
