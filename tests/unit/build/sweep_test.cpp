#include "build/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "build/binned.h"
#include "common/test_scenes.h"

namespace bvhio {
namespace {

/// Returns the least cost of two sides over all planes between centroids on all axes, in any order of equal
/// centroids.
double leastCost(const std::vector<Triangle>& triangles) {
    double least = 1e300;
    const size_t count = triangles.size();
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Aabb> boxes;
        for (const Triangle& t : triangles) boxes.push_back(bounds(t));
        std::stable_sort(boxes.begin(), boxes.end(), [&](const Aabb& a, const Aabb& b) {
            return a.min[axis] + a.max[axis] < b.min[axis] + b.max[axis];
        });
        for (size_t lefts = 1; lefts < count; ++lefts) {
            Aabb left = Aabb::empty(), right = Aabb::empty();
            for (size_t i = 0; i < count; ++i) (i < lefts ? left : right).extend(boxes[i]);
            least = std::min(least, halfArea(left) * double(lefts) + halfArea(right) * double(count - lefts));
        }
    }
    return least;
}

uint32_t trianglesBelow(const Bvh& bvh, uint32_t node) {
    const Node& n = bvh.nodes[node];
    return n.isLeaf() ? n.primitiveCount : trianglesBelow(bvh, n.left()) + trianglesBelow(bvh, n.right());
}

// Every plane of the root is tried: also those after the first and before the last triangle, and those in an
// incomplete group of four.
TEST(Sweep, findsTheBestPlane) {
    for (uint32_t count = 5; count < 40; ++count) {
        const std::vector<Triangle> triangles = test::randomTriangles(count, 1, 0.3f, count);
        BuildOptions options;
        options.maxLeafSize = 1;
        const Bvh bvh = buildSweep(test::sceneOf(triangles), options);
        double cost = 0;
        for (const uint32_t child : {bvh.nodes[0].left(), bvh.nodes[0].right()})
            cost += halfArea(bvh.nodes[child].bounds) * trianglesBelow(bvh, child);
        const double least = leastCost(triangles);
        EXPECT_NEAR(cost, least, 1e-5 * least) << count;
    }
}

// In the order along z, the first and the last triangle have other centroids than the stack between them.
TEST(Sweep, halvesStacksOfEqualCentroids) {
    std::vector<Triangle> triangles(1000, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    triangles.push_back({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}});
    BuildOptions options;
    options.maxLeafSize = 1;
    const Bvh bvh = buildSweep(test::sceneOf(triangles), options);
    uint32_t deepest = 0;
    std::vector<uint32_t> depths(bvh.nodes.size(), 0);
    for (uint32_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1 || bvh.nodes[i].isLeaf()) continue;
        for (const uint32_t child : {bvh.nodes[i].left(), bvh.nodes[i].right()})
            deepest = std::max(deepest, depths[child] = depths[i] + 1);
    }
    EXPECT_LE(deepest, 12u);  // the last four may be in a row
}

TEST(Sweep, costsNoMoreThanBinsOnASurface) {
    const Scene scene = test::sphereScene(200, 100);
    EXPECT_LE(sahCost(buildSweep(scene, {}), {}), sahCost(buildBinned(scene, {}), {}));
}

}  // namespace
}  // namespace bvhio
