#include "build/small_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/test_scenes.h"

namespace bvhio {
namespace {

/// Returns the least cost over all trees, by trying each.
double leastCost(const Reference* references, uint32_t set, const LeafRule& rule) {
    Aabb box = Aabb::empty();
    uint32_t size = 0;
    for (uint32_t i = 0; i < kSmallTree; ++i)
        if (set >> i & 1) {
            const Reference& r = references[i];
            box.extend(
                Aabb{{-r.negatedMin[0], -r.negatedMin[1], -r.negatedMin[2]}, {r.max[0], r.max[1], r.max[2]}});
            ++size;
        }
    double best = size <= rule.maxLeafSize ? rule.intersection * halfArea(box) * size : 1e300;
    for (uint32_t left = (set - 1) & set; left != 0; left = (left - 1) & set)
        best = std::min(best, rule.traversal * halfArea(box) + leastCost(references, left, rule) +
                                  leastCost(references, set ^ left, rule));
    return best;
}

/// Returns the SAH cost of the tree that was written.
double costOf(const Node& node, const std::vector<Node>& nodes, const LeafRule& rule) {
    if (node.isLeaf()) return rule.intersection * halfArea(node.bounds) * node.primitiveCount;
    return rule.traversal * halfArea(node.bounds) + costOf(nodes[node.left()], nodes, rule) +
           costOf(nodes[node.right()], nodes, rule);
}

TEST(SmallTree, costsTheLeastOfAllTrees) {
    for (uint64_t seed = 0; seed < 50; ++seed) {
        const Scene scene = test::sceneOf(test::randomTriangles(kSmallTree, 1, 0.5f, seed));
        Buffer<Reference> references;
        Box bounds;
        makeReferences(scene, references, bounds);
        for (uint32_t count = 1; count <= kSmallTree; ++count)
            for (const LeafRule rule : {LeafRule{1.2f, 1, 4}, LeafRule{1.2f, 1, 1}, LeafRule{0.1f, 1, 2}}) {
                Node root;
                std::vector<Node> nodes(2 * kSmallTree);
                std::vector<uint32_t> primitives(10 + count, ~0u);
                uint32_t nodeCount = 0;
                const double cost = buildSmallTree(references.data(), count, rule, root, nodes.data(),
                                                   nodeCount, primitives.data(), 10);
                const double least = leastCost(references.data(), (1u << count) - 1, rule);
                EXPECT_NEAR(cost, least, 1e-5 * least);
                EXPECT_NEAR(costOf(root, nodes, rule), least, 1e-5 * least);
                EXPECT_LE(nodeCount, 2 * count - 2);
                std::sort(primitives.begin(), primitives.end());
                for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(primitives[i], i);
            }
    }
}

}  // namespace
}  // namespace bvhio
