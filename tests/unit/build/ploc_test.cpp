#include "build/ploc.h"

#include <gtest/gtest.h>

#include <chrono>

#include "build/binned.h"
#include "common/test_scenes.h"

namespace bvhio {
namespace {

Triangle boxed(float x, float size) {
    return {{x, 0, 0}, {x + size, size, 0}, {x, 0, size}};
}

// Three groups along a line, far apart: wherever the Morton order cuts, each group is joined before two
// groups are joined.
TEST(Ploc, joinsWhatIsNearFirst) {
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 49.0f, 100.0f})
        for (int i = 0; i < 5; ++i) triangles.push_back(boxed(x + 0.25f * float(i), 0.1f));
    BuildOptions options;
    options.maxLeafSize = 1;
    const Bvh bvh = buildPloc(test::sceneOf(triangles), options);
    int narrow = 0;  // subtrees of one group, as wide as the group
    for (size_t i = 0; i < bvh.nodes.size(); ++i)
        narrow += i != 1 && bvh.nodes[i].bounds.extent().x > 1 && bvh.nodes[i].bounds.extent().x < 2;
    EXPECT_EQ(narrow, 3);
}

// Boxes that grow along the line: each box finds the box before it, and only the first two find each other.
// One round per triangle would take minutes.
TEST(Ploc, doesNotCreepAlongChains) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 100000; ++i) triangles.push_back(boxed(float(i), 10 + 0.01f * float(i)));
    const Scene scene = test::sceneOf(triangles);
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = buildPloc(scene, {});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_LE(sahCost(bvh, {}), 1.2 * sahCost(buildBinned(scene, {}), {}));
}

// Nested groups with distances that halve again and again make too deep a tree, which must be balanced.
TEST(Ploc, boundsTheDepth) {
    std::vector<Triangle> triangles;
    float x = 1e30f;
    for (int i = 0; i < 150; ++i, x *= 0.5f) triangles.push_back({{x, 0, 0}, {x, x, 0}, {x, 0, x}});
    const Bvh bvh = buildPloc(test::sceneOf(triangles), {});
    std::vector<uint32_t> depths(bvh.nodes.size(), 0);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        EXPECT_LE(depths[i], kMaxDepth);
        if (i != 1 && !bvh.nodes[i].isLeaf())
            depths[bvh.nodes[i].left()] = depths[bvh.nodes[i].right()] = depths[i] + 1;
    }
}

// Tests both surfaces, where splits from the root down are better near the root, and parts of mixed sizes,
// where joining is better.
TEST(Ploc, costsLittleMoreThanBinned) {
    std::vector<Triangle> parts = test::randomTriangles(2000, 1, 0.01f);
    for (const Triangle& t : test::randomTriangles(200, 1, 0.3f, 2)) parts.push_back(t);
    for (const Scene& scene : {test::sphereScene(200, 100), test::sceneOf(parts),
                               test::gridScene(100, [](float x, float y) { return 0.1f * x * y; })})
        for (const SahCosts costs : {SahCosts{}, SahCosts{1, 1}})
            EXPECT_LE(sahCost(buildPloc(scene, {.costs = costs}), costs),
                      1.05 * sahCost(buildBinned(scene, {.costs = costs}), costs));
}

TEST(Ploc, countsTrianglesInPlace) {
    Progress progress;
    BuildOptions options;
    options.progress = &progress;
    const Scene scene = test::sphereScene(300, 100);
    buildPloc(scene, options);
    EXPECT_EQ(progress.total, scene.triangles.size());
    EXPECT_EQ(progress.done, scene.triangles.size());
}

}  // namespace
}  // namespace bvhio
