#include "tree/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "tree/depth.h"
#include "tree/limit_depth.h"

namespace bvhio {
namespace {

/// Returns a chain: each pair is a leaf and the node above the rest. Boxes are intervals of x.
std::vector<Node> chain(uint32_t leaves) {
    std::vector<Node> nodes(2 * leaves);
    const auto box = [&](uint32_t from) { return Aabb{{float(from), 0, 0}, {float(leaves), 1, 1}}; };
    nodes[0] = {box(0), 2, 0};
    nodes[1] = {};
    for (uint32_t i = 0; i + 1 < leaves; ++i) {
        nodes[2 * i + 2] = {{{float(i), 0, 0}, {float(i + 1), 1, 1}}, i, 1};
        nodes[2 * i + 3] = {box(i + 1), 2 * i + 4, 0};
    }
    nodes[2 * leaves - 1] = {box(leaves - 1), leaves - 1, 1};
    return nodes;
}

std::vector<uint32_t> identity(uint32_t count) {
    std::vector<uint32_t> primitives(count);
    for (uint32_t i = 0; i < count; ++i) primitives[i] = i;
    return primitives;
}

TEST(DepthFirst, isTheSameForAnyOrderOfPairs) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.05f));
    const Bvh bvh = builders()[0].function(scene, {});
    const Bvh shuffled = test::shuffledTree(bvh, 3, false);
    EXPECT_TRUE(test::sameBytes(depthFirst({bvh.nodes, bvh.primitives}),
                                depthFirst({shuffled.nodes, shuffled.primitives})));
    EXPECT_EQ(sahCost(depthFirst({shuffled.nodes, shuffled.primitives}), {}), sahCost(bvh, {}));
}

TEST(DepthFirst, balancesWhatIsTooDeep) {
    for (const uint32_t leaves : {kMaxDepth, kMaxDepth + 1, kMaxDepth + 2, 1000u, 50000u}) {
        SCOPED_TRACE(leaves);
        const std::vector<Node> nodes = chain(leaves);
        const std::vector<uint32_t> primitives = identity(leaves);
        const Bvh bvh = depthFirst({nodes, primitives});
        EXPECT_LE(depthOf(bvh), kMaxDepth);
        EXPECT_EQ(bvh.nodes.size(), nodes.size());
        EXPECT_TRUE(std::equal(bvh.primitives.begin(), bvh.primitives.end(), primitives.begin()));
        // A chain that fits is left alone.
        if (leaves <= kMaxDepth + 1) {
            EXPECT_EQ(depthOf(bvh), leaves - 1);
        }
    }
}

// Four unit cubes in a row that touch: one leaf costs 4 * 9 = 36. Two halves are cheaper only if a step is
// cheap.
TEST(Collapse, makesLeavesWhereTheyCostNoMore) {
    const std::vector<Node> nodes = chain(4);
    const std::vector<uint32_t> primitives = identity(4);
    const LooseTree tree{nodes, primitives};
    EXPECT_EQ(collapse(tree, {100, 1}, 4).nodes.size(), 2u);
    EXPECT_EQ(collapse(tree, {100, 1}, 3).nodes.size(), 4u);
    EXPECT_EQ(collapse(tree, {0.1f, 1}, 4).nodes.size(), 8u);
    // A step at 7 + 9 (areas 5 and 9 of pairs and all) equals leaves: the tie goes to the leaf.
    const double cost = collapsedCost(tree, {1.2f, 1}, 4);
    EXPECT_DOUBLE_EQ(cost, sahCost(collapse(tree, {1.2f, 1}, 4), {1.2f, 1}));
}

TEST(Collapse, reachesTheCostItForetells) {
    const Scene scene = test::sceneOf(test::randomTriangles(30000, 1, 0.1f));
    const Bvh single = builders()[0].function(scene, {.costs = {0, 1}, .maxLeafSize = 1});
    for (const uint32_t maxLeafSize : {1u, 2u, 4u, 16u, kMaxLeafSize})
        for (const SahCosts costs : {SahCosts{}, SahCosts{5, 1}, SahCosts{1000, 1}}) {
            const LooseTree tree{single.nodes, single.primitives};
            const Bvh bvh = collapse(tree, costs, maxLeafSize);
            test::expectValid(scene, bvh, maxLeafSize);
            EXPECT_NEAR(collapsedCost(tree, costs, maxLeafSize), sahCost(bvh, costs),
                        1e-9 * sahCost(bvh, costs));
            EXPECT_LE(sahCost(bvh, costs), sahCost(single, costs) * (1 + 1e-12));
        }
    // If a step costs more than any number of tests, one leaf for everything is cheapest.
    EXPECT_EQ(collapse({single.nodes, single.primitives}, {1e9f, 1}, kMaxLeafSize).nodes.size(), 2u);
}

// A triangle that was cut into two parts next to each other: their leaf holds it once.
TEST(Collapse, joinsTheReferencesOfASplitTriangle) {
    std::vector<Node> nodes = chain(3);
    const std::vector<uint32_t> primitives{0, 1, 1};
    const Bvh bvh = collapse({nodes, primitives}, {1, 1}, 1);
    ASSERT_EQ(bvh.nodes.size(), 4u);
    EXPECT_EQ(bvh.nodes[3].primitiveCount, 1u);
    EXPECT_EQ(bvh.primitives.size(), 2u);
    EXPECT_EQ(collapse({nodes, primitives}, {100, 1}, 2).nodes.size(), 2u);
}

}  // namespace
}  // namespace bvhio
