#include "restructure/treelets.h"

#include <gtest/gtest.h>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/random_treelet.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "restructure/atr.h"
#include "restructure/tr.h"

namespace bvhio {
namespace {

std::vector<Treelet> seen;

bool keepAsItIs(const Treelet& treelet, const TreeletCosts&, float, TreeletPlan&) {
    seen.push_back(treelet);
    return false;
}

Bvh oneTriangleALeaf(const Scene& scene) {
    return choose(builders(), "builder", "median").function(scene, {.costs = {}, .maxLeafSize = 1});
}

/// Returns the boxes of a treelet's leaves, found step by step.
std::vector<Aabb> leavesOf(const Bvh& bvh, uint32_t root, uint32_t size) {
    std::vector<uint32_t> leaves{bvh.nodes[root].left(), bvh.nodes[root].right()};
    while (leaves.size() < size) {
        size_t largest = leaves.size();
        for (size_t i = 0; i < leaves.size(); ++i) {
            const Node& node = bvh.nodes[leaves[i]];
            if (!node.isLeaf() && (largest == leaves.size() ||
                                   halfArea(node.bounds) > halfArea(bvh.nodes[leaves[largest]].bounds)))
                largest = i;
        }
        if (largest == leaves.size()) break;
        const Node& node = bvh.nodes[leaves[largest]];
        leaves[largest] = node.left();
        leaves.push_back(node.right());
    }
    std::vector<Aabb> boxes;
    for (const uint32_t leaf : leaves) boxes.push_back(bvh.nodes[leaf].bounds);
    return boxes;
}

// On a grid areas are equal. Then the first leaf is replaced.
TEST(Treelets, replaceTheLargestLeaf) {
    const Scene scenes[] = {test::sceneOf(test::randomTriangles(100, 1, 0.3f)),
                            test::gridScene(8, [](float, float) { return 0.0f; }), test::sphereScene(3, 2)};
    for (const Scene& scene : scenes) {
        const Bvh bvh = oneTriangleALeaf(scene);
        for (const uint32_t size : {3u, 4u, 7u, 9u, kMaxTreeletSize}) {
            seen.clear();
            RestructureOptions options;
            options.gamma = uint32_t(scene.triangles.size());  // only the root has that many references
            restructureTreelets(scene, bvh, options, {size, size, 1, 1, keepAsItIs});
            ASSERT_EQ(seen.size(), 1u);
            const std::vector<Aabb> expected = leavesOf(bvh, 0, size);
            ASSERT_EQ(seen[0].size, expected.size());
            // Coordinates are scaled by a power of two.
            const Aabb& root = bvh.nodes[0].bounds;
            float low = seen[0].boxes[0][0], high = seen[0].boxes[3][0];
            for (uint32_t i = 1; i < seen[0].size; ++i) {
                low = std::max(low, seen[0].boxes[0][i]);
                high = std::max(high, seen[0].boxes[3][i]);
            }
            const float scale = (low + high) / (root.max.x - root.min.x);
            for (uint32_t i = 0; i < expected.size(); ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_EQ(seen[0].boxes[axis][i], -expected[i].min[axis] * scale) << size << " " << i;
                    EXPECT_EQ(seen[0].boxes[axis + 3][i], expected[i].max[axis] * scale) << size << " " << i;
                }
        }
    }
}

TEST(Treelets, rootAtNodesWithEnoughReferences) {
    const Scene scene = test::sceneOf(test::randomTriangles(10000, 1, 0.05f));
    const Bvh bvh = oneTriangleALeaf(scene);
    std::vector<uint32_t> references(bvh.nodes.size(), 1);
    for (auto i = uint32_t(bvh.nodes.size()); i-- > 0;)
        if (!bvh.nodes[i].isLeaf())
            references[i] = references[bvh.nodes[i].left()] + references[bvh.nodes[i].right()];
    for (const uint32_t gamma : {1u, 3u, 9u, 100u, 10000u}) {
        seen.clear();
        RestructureOptions options;
        options.gamma = gamma;
        options.collapse = false;
        const ThreadLimit limit(1);  // `seen` is not thread-safe
        const Restructured result = restructureTreelets(scene, bvh, options, {9, 9, 1, 1, keepAsItIs});
        const auto enough = [&](uint32_t count) { return count >= std::max(gamma, 3u); };
        // The unused slot counts as one.
        EXPECT_EQ(seen.size(), size_t(std::count_if(references.begin(), references.end(), enough)));
        EXPECT_TRUE(test::sameBytes(result.bvh, bvh));
    }
}

TEST(Treelets, stopWhenNoNodeHasEnoughReferences) {
    const Scene scene = test::sceneOf(test::randomTriangles(100, 1, 0.1f));
    const Bvh bvh = oneTriangleALeaf(scene);
    RestructureOptions options;
    options.iterations = 100000;
    EXPECT_EQ(restructureAtr(scene, bvh, options).iterations.size(), 4u);  // 9, 18, 36, 72
    EXPECT_EQ(restructureTr(scene, bvh, options).iterations.size(), 4u);   // 7, 14, 28, 56
    options.gamma = 101;
    EXPECT_EQ(restructureAtr(scene, bvh, options).iterations.size(), 0u);
    options.gamma = ~0u;
    EXPECT_EQ(restructureTr(scene, bvh, options).iterations.size(), 0u);
}

// Treelets are judged with the leaves that will form, so no iteration can raise the cost.
TEST(Treelets, lowerTheCostInEveryIteration) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.02f));
    const Bvh bvh = choose(builders(), "builder", "lbvh").function(scene, {});
    for (const bool collapse : {true, false})
        for (const auto method : {restructureAtr, restructureTr}) {
            RestructureOptions options;
            options.iterations = 3;
            options.gamma = 6;
            options.collapse = collapse;
            options.recordCosts = true;
            Progress progress;
            options.progress = &progress;
            const Restructured result = method(scene, bvh, options);
            ASSERT_EQ(result.iterations.size(), 3u);
            double cost = sahCost(bvh, options.costs);
            for (const RestructureIteration& iteration : result.iterations) {
                EXPECT_GT(iteration.changes, 0u);
                EXPECT_LT(iteration.sahCost, cost);
                cost = iteration.sahCost;
            }
            EXPECT_EQ(progress.done.load(), progress.total.load());
            EXPECT_LT(result.bytesPerNode, 64);  // the papers' figure
        }
}

}  // namespace
}  // namespace bvhio
