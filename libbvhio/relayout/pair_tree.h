// The tree that layouts put in order: its nodes are sibling pairs, each fetched as one record.
#pragma once

#include <array>

#include "relayout/node_order.h"
#include "relayout/pair_weights.h"
#include "tree/connected_parts.h"

namespace bvhio {

/// Pairs are numbered depth first, left before right, whatever their order in memory: so a parent's number is
/// below its children's, a subtree's numbers are one run, and ties that go to the lower number go left.
/// Empty for a tree of one leaf.
struct PairTree {
    static constexpr uint32_t kNone = TreeItem::kNone;

    struct Pair {
        uint32_t left;    // index of the left node
        uint32_t parent;  // kNone: the first pair
        std::array<uint32_t, 2>
            children;   // the pair below the left node and that below the right; kNone: a leaf
        uint32_t size;  // pairs in the subtree
        double weight;  // how often it is fetched, in any unit; never above the parent's
    };
    std::vector<Pair> pairs;

    PairTree(const Bvh& bvh, const PairWeights& weights);

    size_t size() const { return pairs.size(); }
    const Pair& operator[](uint32_t pair) const { return pairs[pair]; }
    /// The children that are pairs, the likelier one first where `likelierFirst`, else left before right.
    /// Returns how many.
    uint32_t children(uint32_t pair, bool likelierFirst, std::array<uint32_t, 2>& found) const {
        uint32_t count = 0;
        for (const uint32_t child : pairs[pair].children)
            if (child != kNone) found[count++] = child;
        if (likelierFirst && count == 2 && pairs[found[1]].weight > pairs[found[0]].weight)
            std::swap(found[0], found[1]);
        return count;
    }
    /// Children and weights alone.
    std::vector<TreeItem> items() const;
    /// An order of numbers as one of nodes.
    NodeOrder nodeOrder(const std::vector<uint32_t>& numbers) const;
};

}  // namespace bvhio
