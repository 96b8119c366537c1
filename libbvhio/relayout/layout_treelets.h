// Orders made of treelets: groups of pairs that rays tend to go through together, one behind the other. They
// have nothing in common with the treelets that restructuring rebuilds.
#pragma once

#include "relayout/pair_tree.h"

namespace bvhio {

enum class TreeletGrowth { depthFirst, breadthFirst };

struct TreeletRule {
    TreeletGrowth growth;
    double
        threshold;  // a treelet goes on to children whose probability, when their parent is entered, is above
    uint32_t maxPairs;  // of a treelet
};

/// All pairs of the tree.
std::vector<uint32_t> orderTreelets(const PairTree& tree, const TreeletRule& rule);

}  // namespace bvhio
