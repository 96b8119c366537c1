// A tree that is made from the leaves up, and then turned into a canonical one.
#pragma once

#include <hwy/cache_control.h>

#include <algorithm>
#include <vector>

#include "build/morton.h"
#include "build/reference.h"
#include "build/small_tree.h"

namespace bvhio {

/// Sibling pairs in the order in which they were joined, over leaves of one triangle each, in Morton order. A
/// cluster is the root of a subtree: a Reference with the cluster's box and, as `primitive`, a key of either
/// a leaf or the pair below the cluster. Each join decides at once whether the joined subtree becomes a leaf.
class MergedTree {
  public:
    MergedTree(const Scene& scene, const MortonOrder& order, const LeafRule& rule);

    /// Returns the key of a cluster of one leaf.
    static uint32_t leafKey(uint32_t place) { return 2 * place + 1; }

    /// Starts a round of joins: pairs from number `pair` on may be above earlier ones. Forgets pairs that
    /// were joined from that number on.
    void startRound(uint32_t pair) {
        while (!rounds_.empty() && rounds_.back() >= pair) rounds_.pop_back();
        rounds_.push_back(pair);
    }

    /// Prefetches the data that `join` will read about a cluster.
    void prefetch(const Reference& cluster) const {
        if (!isLeaf(cluster.primitive)) hwy::Prefetch(&pairs_[cluster.primitive / 2].below);
    }

    /// Joins two clusters as pair `number`, and returns the cluster above it. May be called from several
    /// threads at once, for different pairs.
    Reference join(uint32_t number, const Reference& left, const Reference& right) {
        Pair& pair = pairs_[number];
        Reference above;
        for (int axis = 0; axis < 3; ++axis) {
            pair.negatedMin[axis] = above.negatedMin[axis] =
                std::max(left.negatedMin[axis], right.negatedMin[axis]);
            pair.max[axis] = above.max[axis] = std::max(left.max[axis], right.max[axis]);
        }
        above.primitive = 2 * number;
        above.unused = 0;
        pair.keys[0] = left.primitive;
        pair.keys[1] = right.primitive;
        const Below a = below(left), b = below(right);
        pair.below.leaves = a.leaves + b.leaves;
        pair.below.slots = 2 + a.slots + b.slots;
        pair.below.height = 1 + std::max(a.height, b.height);
        const float area = halfArea(above), leafCost = rule_.cost(area, pair.below.leaves);
        pair.below.cost = rule_.traversal * area + a.cost + b.cost;
        if (pair.below.leaves <= rule_.maxLeafSize && leafCost <= pair.below.cost) {
            pair.below.cost = leafCost;
            pair.below.slots = 0;
        }
        return above;
    }

    /// Returns the SAH cost of a cluster's subtree, not divided by the root's area.
    float cost(const Reference& cluster) const { return below(cluster).cost; }

    /// Makes the canonical tree. This tree cannot be used afterwards.
    Bvh finish(const Reference& root);

  private:
    /// Sizes of the subtree below a cluster. `finish` replaces them, from the root down, by the subtree's
    /// places in the canonical tree.
    struct Below {
        uint32_t leaves;  // their number; then: the place of the first leaf's primitive
        uint32_t slots;   // number of slots for nodes, 0 = a leaf; then: the place of the pair, 0 = in a leaf
        float cost;
        uint32_t height;
    };
    struct Pair {
        float negatedMin[3], max[3];
        uint32_t keys[2];
        Below below;
    };

    static bool isLeaf(uint32_t key) { return (key & 1) != 0; }
    static float halfArea(const Reference& box) {
        const float x = box.max[0] + box.negatedMin[0], y = box.max[1] + box.negatedMin[1],
                    z = box.max[2] + box.negatedMin[2];
        return x * y + y * z + z * x;
    }
    Below below(const Reference& cluster) const {
        if (isLeaf(cluster.primitive)) return {1, 0, rule_.cost(halfArea(cluster), 1), 0};
        return pairs_[cluster.primitive / 2].below;
    }
    uint32_t leafCount() const { return uint32_t(order_.triangles.size()); }
    Aabb boundsOf(uint32_t key) const;
    void prefetchBelow(uint32_t number) const;
    void prefetchTriangles(uint32_t number) const;
    void place(uint32_t number, Node* nodes, uint32_t* primitives);
    Bvh finishDeep(const Reference& root) const;

    const Scene& scene_;
    const MortonOrder& order_;
    const LeafRule rule_;
    Buffer<Pair> pairs_;
    std::vector<uint32_t> rounds_;  // the first pair of each round
};

}  // namespace bvhio
