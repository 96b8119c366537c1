// The tree as layouts see it: its nodes are sibling pairs, each of which is fetched as one record.
#pragma once

#include <array>

#include "relayout/node_order.h"
#include "relayout/pair_weights.h"
#include "tree/connected_parts.h"

namespace bvhio {

/// Pairs are numbered depth first, left before right, independently of their order in memory. So a parent's
/// number is less than its children's, the numbers of a subtree are one run, and a tie that goes to the lower
/// number goes left. The tree of a single leaf has no pairs.
struct PairTree {
    static constexpr uint32_t kNone = TreeItem::kNone;

    struct Pair {
        uint32_t left;                     // index of the left node
        uint32_t parent;                   // kNone: the first pair
        std::array<uint32_t, 2> children;  // the pairs below the left and the right node; kNone: a leaf
        uint32_t size;                     // pairs in the subtree
        double weight;                     // how often the pair is fetched, in any unit; at most the parent's
    };
    std::vector<Pair> pairs;

    PairTree(const Bvh& bvh, const PairWeights& weights);

    size_t size() const { return pairs.size(); }
    const Pair& operator[](uint32_t pair) const { return pairs[pair]; }
    /// Writes the pairs below a pair to `found`: the likelier one first if `likelierFirst`, and else left
    /// before right. Returns their number.
    uint32_t children(uint32_t pair, bool likelierFirst, std::array<uint32_t, 2>& found) const {
        uint32_t count = 0;
        for (const uint32_t child : pairs[pair].children)
            if (child != kNone) found[count++] = child;
        if (likelierFirst && count == 2 && pairs[found[1]].weight > pairs[found[0]].weight)
            std::swap(found[0], found[1]);
        return count;
    }
    /// Returns the tree as items with only children and weights.
    std::vector<TreeItem> items() const;
    /// Converts an order of numbers into an order of nodes.
    NodeOrder nodeOrder(const std::vector<uint32_t>& numbers) const;
};

}  // namespace bvhio
