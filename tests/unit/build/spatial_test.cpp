#include "build/spatial.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/binned.h"
#include "common/test_scenes.h"
#include "core/clip_triangle.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

/// Returns small triangles, and among them long thin ones with large boxes: only cutting these helps.
Scene straws(uint32_t count) {
    std::vector<Triangle> triangles = test::randomTriangles(count - count / 10, 1, 0.01f);
    for (const Triangle& t : test::randomTriangles(count / 10, 1, 0.5f, 2))
        triangles.push_back({t.v0, t.v1, t.v1 * 0.99f + t.v2 * 0.01f});
    return test::sceneOf(triangles);
}

BuildOptions withBudget(float budget) {
    BuildOptions options;
    options.splitBudget = budget;
    return options;
}

TEST(Spatial, refusesOptionsOutOfRange) {
    const Scene scene = test::sphereScene(8, 4);
    BuildOptions bins;
    bins.bins = 1;
    EXPECT_THROW(buildSpatial(scene, bins), Error);
    for (const float budget : {-0.1f, kMaxSplitBudget + 1, std::nanf("")})
        EXPECT_THROW(buildSpatial(scene, withBudget(budget)), Error) << budget;
}

TEST(Spatial, cutsWhereItPays) {
    const Scene scene = straws(5000);
    const double binned = sahCost(buildBinned(scene, {}), {});
    const Bvh bvh = buildSpatial(scene, {});
    EXPECT_GT(bvh.primitives.size(), scene.triangles.size());
    EXPECT_LT(sahCost(bvh, {}), 0.8 * binned);
    // Where cuts cannot help, there must be none.
    const Scene flat = test::gridScene(60, [](float, float) { return 0.0f; });
    EXPECT_EQ(buildSpatial(flat, {}).primitives.size(), flat.triangles.size());
}

TEST(Spatial, keepsToItsBudgetAndUsesIt) {
    const Scene scene = straws(20000);
    double last = 1e300;
    for (const float budget : {0.0f, 0.1f, 0.3f}) {
        const Bvh bvh = buildSpatial(scene, withBudget(budget));
        const double references = double(bvh.primitives.size()) / double(scene.triangles.size());
        EXPECT_LE(references, 1 + double(budget));
        EXPECT_GE(references, 1 + 0.8 * double(budget));
        const double cost = sahCost(bvh, {});
        EXPECT_LT(cost, last);
        last = cost;
    }
}

// If both parts of a cut triangle were kept in one leaf, the triangle would be tested twice.
TEST(Spatial, noLeafHoldsATriangleTwice) {
    for (const uint32_t maxLeafSize : {2u, 4u, 64u})
        for (const SahCosts costs : {SahCosts{1, 1}, SahCosts{20, 1}}) {
            BuildOptions options;
            options.maxLeafSize = maxLeafSize;
            options.costs = costs;
            options.splitBudget = 2;
            const Bvh bvh = buildSpatial(straws(3000), options);
            for (size_t i = 0; i < bvh.nodes.size(); ++i) {
                const Node& node = bvh.nodes[i];
                std::vector<uint32_t> held(bvh.primitives.begin() + node.first,
                                           bvh.primitives.begin() + node.first + node.primitiveCount);
                if (i == 1 || !node.isLeaf()) continue;
                std::sort(held.begin(), held.end());
                EXPECT_EQ(std::adjacent_find(held.begin(), held.end()), held.end()) << "node " << i;
            }
        }
}

// Each point of a triangle must be in the box of one of its leaves. Otherwise rays miss it.
TEST(Spatial, leavesHoldTheirTrianglesTogether) {
    for (const float scale : {1.0f, 1e-8f, 1e8f}) {
        Scene scene = straws(2000);
        std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
        for (Vec3& v : vertices) v = v * scale;
        scene.vertices = std::move(vertices);
        const Bvh bvh = buildSpatial(scene, withBudget(2));
        std::vector<std::vector<Aabb>> boxes(scene.triangles.size());
        for (size_t i = 0; i < bvh.nodes.size(); ++i)
            for (uint32_t k = 0; i != 1 && k < bvh.nodes[i].primitiveCount; ++k)
                boxes[bvh.primitives[bvh.nodes[i].first + k]].push_back(bvh.nodes[i].bounds);
        Random random(3);
        for (uint32_t t = 0; t < boxes.size(); ++t)
            for (int sample = 0; sample < 50; ++sample) {
                const Triangle triangle = scene.triangle(t);
                double u = random.uniform(), v = random.uniform();
                if (u + v > 1) u = 1 - u, v = 1 - v;
                bool held = false;
                for (const Aabb& box : boxes[t]) {
                    bool inside = true;
                    for (int axis = 0; axis < 3; ++axis) {
                        const double x =
                            triangle.v0[axis] * (1 - u - v) + triangle.v1[axis] * u + triangle.v2[axis] * v;
                        inside &= x >= box.min[axis] && x <= box.max[axis];
                    }
                    held |= inside;
                }
                ASSERT_TRUE(held) << "triangle " << t << " scale " << scale;
            }
    }
}

// Boxes around whole triangles are also valid for a tree with parts, but larger.
TEST(Spatial, treesCanBeRefitted) {
    const Scene scene = straws(1000);
    const Bvh bvh = buildSpatial(scene, {});
    const PrimitiveBounds boxes = [&](std::span<const uint32_t> primitives, Aabb* out) {
        for (const uint32_t p : primitives) *out++ = bounds(scene.triangle(p));
    };
    const auto count = uint32_t(scene.triangles.size());
    EXPECT_TRUE(validate(bvh, count, boxes).findings.empty());
    const Bvh whole = refit(bvh, boxes);
    EXPECT_TRUE(validate(whole, count, boxes).findings.empty());
    EXPECT_GT(sahCost(whole, {}), sahCost(bvh, {}));
}

TEST(Spatial, progressEndsAtItsTotal) {
    Progress progress;
    BuildOptions options;
    options.progress = &progress;
    buildSpatial(straws(30000), options);
    EXPECT_EQ(progress.done, progress.total);
    EXPECT_GE(progress.total, 30000u);
}

}  // namespace
}  // namespace bvhio
