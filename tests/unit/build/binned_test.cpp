#include "build/binned.h"

#include <gtest/gtest.h>

#include <cstring>

#include "common/test_scenes.h"

namespace bvhio {
namespace {

TEST(Binned, refusesBinsOutOfRange) {
    const Scene scene = test::sphereScene(8, 4);
    for (const uint32_t bins : {1u, kMaxBins + 1}) {
        BuildOptions options;
        options.bins = bins;
        EXPECT_THROW(buildBinned(scene, options), Error) << bins;
    }
    BuildOptions most;
    most.bins = kMaxBins;
    EXPECT_GT(buildBinned(scene, most).nodeCount(), 1u);
}

// Two clusters far apart: for any number of bins, the first split must be a plane between them.
TEST(Binned, splitsWhereTheSpaceIsEmpty) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 100; ++i) {
        const float x = (i % 2 == 0 ? 0.0f : 900.0f) + float(i) * 0.01f;
        triangles.push_back({{x, 0, 0}, {x + 0.01f, 1, 0}, {x, 0, 1}});
    }
    const Scene scene = test::sceneOf(triangles);
    for (const uint32_t bins : {0u, 2u, 3u, 16u, 256u}) {
        BuildOptions options;
        options.bins = bins;
        const Bvh bvh = buildBinned(scene, options);
        EXPECT_LT(bvh.nodes[bvh.nodes[0].left()].bounds.max.x, 2) << bins;
        EXPECT_GT(bvh.nodes[bvh.nodes[0].right()].bounds.min.x, 899) << bins;
    }
}

// One large triangle spans the box. All small triangles share one of its bins, and must still be separated.
TEST(Binned, zoomsInWhenAllCentroidsShareABin) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 64; ++i) {
        const float x = 100 + float(i) * 1e-2f;
        triangles.push_back({{x, 1, 1}, {x + 1e-2f, 2, 1}, {x, 1, 2}});
    }
    triangles.push_back({{-9700, -9700, -9700}, {10300, 10300, 10300}, {300, 300, 300}});
    const Scene scene = test::sceneOf(triangles);
    BuildOptions options;
    options.maxLeafSize = 1;
    const Bvh bvh = buildBinned(scene, options);
    // If the large triangle is separated at once, the rest costs almost nothing. Halving would visit the
    // large box 5 times.
    EXPECT_LT(sahCost(bvh, {1, 1}), 3);
}

}  // namespace
}  // namespace bvhio
