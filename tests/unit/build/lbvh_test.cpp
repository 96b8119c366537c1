#include "build/lbvh.h"

#include <gtest/gtest.h>

#include "common/test_scenes.h"

namespace bvhio {
namespace {

Triangle pointAt(Vec3 p) {
    return {p, p, p};
}

/// Returns a triangle at the corner of [0, side]^3, which fixes the grid.
Triangle cornerAt(float side) {
    return {{side, side, side}, {side, side, side}, {side, side, side}};
}

// The tree follows the codes, not the areas: x halves the cube first, although y would be cheaper.
TEST(Lbvh, splitsWhereTheHighestBitChanges) {
    std::vector<Triangle> triangles{pointAt({0, 0, 0}), cornerAt(8)};
    for (const float x : {1.0f, 7.0f})
        for (const float y : {1.0f, 1.5f}) triangles.push_back(pointAt({x, y, 0}));
    BuildOptions options;
    options.maxLeafSize = 1;
    const Bvh bvh = buildLbvh(test::sceneOf(triangles), options);
    const Node &left = bvh.nodes[bvh.nodes[0].left()], &right = bvh.nodes[bvh.nodes[0].right()];
    EXPECT_EQ(left.bounds, (Aabb{{0, 0, 0}, {1, 1.5f, 0}}));
    EXPECT_EQ(right.bounds, (Aabb{{7, 1, 0}, {8, 8, 8}}));
    // On the right, the corner differs from the others in y first.
    EXPECT_EQ(bvh.nodes[right.left()].bounds, (Aabb{{7, 1, 0}, {7, 1.5f, 0}}));
}

// Slots of pairs that end up inside leaves are reused, so that no gaps remain.
TEST(Lbvh, leavesNoGapsWhereSubtreesBecomeLeaves) {
    for (const float traversal : {0.01f, 0.5f, 1.2f, 100.0f})
        for (const uint32_t maxLeafSize : {1u, 3u, 8u, 10000u}) {
            const Scene scene = test::sphereScene(100, 60);
            const Bvh bvh = buildLbvh(scene, {.costs = {traversal, 1}, .maxLeafSize = maxLeafSize});
            size_t leaves = 0, primitives = 0;
            for (size_t i = 0; i < bvh.nodes.size(); ++i) {
                if (i == 1 || !bvh.nodes[i].isLeaf()) continue;
                ++leaves;
                // In depth-first order, each leaf's range follows the one before.
                EXPECT_LE(bvh.nodes[i].primitiveCount, maxLeafSize);
                primitives += bvh.nodes[i].primitiveCount;
            }
            EXPECT_EQ(primitives, scene.triangles.size());
            EXPECT_EQ(bvh.nodes.size(), 2 * leaves);
        }
}

// Subtrees by different tasks give the same tree as a single task.
TEST(Lbvh, doesNotShowWhereTheOrderWasCut) {
    const Scene scene = test::sphereScene(300, 200);
    const Bvh cut = buildLbvh(scene, {.costs = {0.001f, 1}});
    // A larger limit on leaves makes the whole scene one subtree. With these costs no leaf gets that large.
    const Bvh whole = buildLbvh(scene, {.costs = {0.001f, 1}, .maxLeafSize = kMaxLeafSize * 2});
    ASSERT_EQ(cut.nodes.size(), whole.nodes.size());
    for (size_t i = 0; i < cut.nodes.size(); ++i) {
        ASSERT_EQ(cut.nodes[i].bounds, whole.nodes[i].bounds) << i;
        ASSERT_EQ(cut.nodes[i].first, whole.nodes[i].first) << i;
    }
}

TEST(Lbvh, countsTrianglesInPlace) {
    Progress progress;
    BuildOptions options;
    options.progress = &progress;
    const Scene scene = test::sphereScene(300, 100);
    buildLbvh(scene, options);
    EXPECT_EQ(progress.total, scene.triangles.size());
    EXPECT_EQ(progress.done, scene.triangles.size());
}

}  // namespace
}  // namespace bvhio
