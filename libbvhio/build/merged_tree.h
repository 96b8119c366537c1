// A tree made from the leaves up, and how it becomes canonical.
#pragma once

#include <hwy/cache_control.h>

#include <algorithm>
#include <vector>

#include "build/morton.h"
#include "build/reference.h"
#include "build/small_tree.h"

namespace bvhio {

/// Sibling pairs in the order in which they were joined, over leaves of one triangle each, in Morton order. A
/// cluster is the root of what was joined so far: its box, and as `primitive` a key that tells which leaf it
/// is or which pair is below it. Which subtrees become leaves is decided at once.
class MergedTree {
  public:
    MergedTree(const Scene& scene, const MortonOrder& order, const LeafRule& rule);

    /// The key of a cluster of one leaf.
    static uint32_t leafKey(uint32_t place) { return 2 * place + 1; }

    /// Tells that pairs from number `pair` on may be above those before. What was joined from there on is
    /// forgotten.
    void startRound(uint32_t pair) {
        while (!rounds_.empty() && rounds_.back() >= pair) rounds_.pop_back();
        rounds_.push_back(pair);
    }

    /// Asks for what `join` will read about a cluster.
    void prefetch(const Reference& cluster) const {
        if (!isLeaf(cluster.primitive)) hwy::Prefetch(&pairs_[cluster.primitive / 2].below);
    }

    /// Joins two clusters as pair number `pair`, and returns the cluster above. From several threads at once,
    /// for different pairs.
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

    /// The SAH cost of what is below a cluster, times areas.
    float cost(const Reference& cluster) const { return below(cluster).cost; }

    /// Makes the canonical tree, after which nothing can be done with this one.
    Bvh finish(const Reference& root);

  private:
    /// What is below a cluster; and then, from the root down, where in the canonical tree that goes.
    struct Below {
        uint32_t leaves;  // then: place of the first one's primitive
        uint32_t slots;   // for nodes, 0 = it is a leaf; then: place of the pair, 0 = in a leaf
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
    std::vector<uint32_t> rounds_;  // the first pair of each
};

}  // namespace bvhio
