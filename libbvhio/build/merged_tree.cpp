// Nodes get their places from the root down: a pair that has its place gives places to its children, which
// are in earlier rounds. Pairs of the same round don't depend on each other. So passes over the rounds, from
// the last to the first, put every node at its depth-first place, without walking the tree.

#include "build/merged_tree.h"

#include <utility>

#include "core/parallel.h"
#include "tree/collapse.h"

namespace bvhio {

MergedTree::MergedTree(const Scene& scene, const MortonOrder& order, const LeafRule& rule)
    : scene_(scene), order_(order), rule_(rule), pairs_(order.triangles.size()) {}

Aabb MergedTree::boundsOf(uint32_t key) const {
    if (isLeaf(key)) {
        const Aabb box = bounds(scene_.triangle(order_.triangles[key / 2]));
        return {box.min * order_.scale, box.max * order_.scale};
    }
    const Pair& pair = pairs_[key / 2];
    return {{0 - pair.negatedMin[0], 0 - pair.negatedMin[1], 0 - pair.negatedMin[2]},
            {pair.max[0], pair.max[1], pair.max[2]}};
}

Bvh MergedTree::finish(const Reference& root) {
    const Below all = below(root);
    if (all.height > kMaxDepth) return finishDeep(root);
    Buffer<Node> nodes(2 + all.slots);
    Buffer<uint32_t> primitives(leafCount());
    const uint32_t firstSlot = all.slots == 0 ? 0 : 2;
    nodes[0] = {boundsOf(root.primitive), firstSlot, all.slots == 0 ? all.leaves : 0};
    nodes[1] = {};
    if (isLeaf(root.primitive)) {
        primitives[0] = order_.triangles[root.primitive / 2];
    } else {
        pairs_[root.primitive / 2].below.leaves = 0;
        pairs_[root.primitive / 2].below.slots = firstSlot;
    }

    // Place the pairs of each round, the last round first.
    constexpr size_t kGrain = 1 << 12;
    uint32_t end = leafCount() - 1;
    for (size_t round = rounds_.size(); round-- > 0;) {
        const uint32_t begin = rounds_[round];
        parallelChunks(end - begin, kGrain, [&](size_t first, size_t last) {
            constexpr size_t kAhead = 16;
            for (size_t i = last; i-- > first;) {
                prefetchBelow(begin + uint32_t(std::max(i, first + 2 * kAhead) - 2 * kAhead));
                prefetchTriangles(begin + uint32_t(std::max(i, first + kAhead) - kAhead));
                place(begin + uint32_t(i), nodes.data(), primitives.data());
            }
        });
        end = begin;
    }
    return {std::move(nodes).share(), std::move(primitives).share()};
}

/// Prefetch, in two steps, the data that `place` reads, which is anywhere in memory.
void MergedTree::prefetchBelow(uint32_t number) const {
    for (const uint32_t key : pairs_[number].keys) {
        if (isLeaf(key))
            hwy::Prefetch(&scene_.triangles[order_.triangles[key / 2]]);
        else
            hwy::Prefetch(&pairs_[key / 2].below);
    }
}
void MergedTree::prefetchTriangles(uint32_t number) const {
    for (const uint32_t key : pairs_[number].keys) {
        if (!isLeaf(key)) continue;
        const TriangleIndices& t = scene_.triangles[order_.triangles[key / 2]];
        for (const uint32_t vertex : {t.v0, t.v1, t.v2}) hwy::Prefetch(&scene_.vertices[vertex]);
    }
}

/// Writes the nodes of a pair, and gives the pairs below them their places.
void MergedTree::place(uint32_t number, Node* nodes, uint32_t* primitives) {
    const Pair& pair = pairs_[number];
    const uint32_t slot = pair.below.slots;
    uint32_t nextSlot = slot + 2, nextPrimitive = pair.below.leaves;
    for (uint32_t side = 0; side < 2; ++side) {
        const uint32_t key = pair.keys[side], first = nextPrimitive;
        uint32_t leaves = 1, slots = 0;
        if (isLeaf(key)) {
            primitives[first] = order_.triangles[key / 2];
        } else {
            Below& below = pairs_[key / 2].below;
            leaves = std::exchange(below.leaves, first);
            slots = below.slots;
            below.slots = slot == 0 || slots == 0 ? 0 : nextSlot;
        }
        nextPrimitive += leaves;
        if (slot == 0) continue;
        nodes[slot + side] =
            slots == 0 ? Node{boundsOf(key), first, leaves} : Node{boundsOf(key), nextSlot, 0};
        nextSlot += slots;
    }
}

/// Makes the tree by `collapse`, which balances subtrees that are too deep.
Bvh MergedTree::finishDeep(const Reference& root) const {
    Buffer<Node> nodes(2 * order_.triangles.size());
    const auto loose = [&](uint32_t key) {
        return isLeaf(key) ? Node{boundsOf(key), key / 2, 1} : Node{boundsOf(key), key + 2, 0};
    };
    nodes[0] = loose(root.primitive);
    nodes[1] = {};
    for (uint32_t i = 0; i + 1 < leafCount(); ++i)
        for (uint32_t side = 0; side < 2; ++side) nodes[2 + 2 * i + side] = loose(pairs_[i].keys[side]);
    return collapse({{nodes.data(), nodes.size()}, {order_.triangles.data(), leafCount()}},
                    {rule_.traversal, rule_.intersection}, rule_.maxLeafSize);
}

}  // namespace bvhio
