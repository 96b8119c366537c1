// Orders made of treelets: groups of pairs, one group after another, that rays tend to visit together. They
// are unrelated to the treelets that restructuring rebuilds.
#pragma once

#include "relayout/pair_tree.h"

namespace bvhio {

enum class TreeletGrowth { depthFirst, breadthFirst };

struct TreeletRule {
    TreeletGrowth growth;
    double threshold;   // a treelet contains children whose probability, if their parent is entered, is above
                        // this
    uint32_t maxPairs;  // the most pairs of a treelet
};

/// Returns all pairs of the tree, in the order of treelets.
std::vector<uint32_t> orderTreelets(const PairTree& tree, const TreeletRule& rule);

}  // namespace bvhio
