#include "stats/slack.h"

#include <gtest/gtest.h>

#include "build/spatial.h"
#include "build/sweep.h"
#include "common/test_scenes.h"
#include "compress/forms.h"
#include "core/report.h"

namespace bvhio {
namespace {

/// Returns a root over two leaves with a unit square each. The second leaf has a box of twice the area.
struct TwoSquares {
    Scene scene = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{4, 0, 0}, {5, 0, 0}, {4, 1, 0}}});
    Bvh bvh;
    TwoSquares() {
        bvh.nodes = AlignedVector<Node>{{{{0, 0, 0}, {5, 1, 0}}, 2, 0},
                                        {},
                                        {{{0, 0, 0}, {1, 1, 0}}, 0, 1},
                                        {{{3, 0, 0}, {5, 1, 0}}, 1, 1}};
        bvh.primitives = std::vector<uint32_t>{0, 1};
    }
};

TEST(Slack, comparesAreasLevelByLevel) {
    const TwoSquares two;
    const SlackStats stats = slackStats(two.scene, two.bvh, {.traversal = 1, .intersection = 10});
    ASSERT_EQ(stats.levels.size(), 2u);
    EXPECT_EQ(stats.levels[0].total(), 1);
    EXPECT_EQ(stats.levels[1].nodes, 2u);
    EXPECT_DOUBLE_EQ(stats.levels[1].total(), 1.5);
    EXPECT_DOUBLE_EQ(stats.levels[1].mean(), 1.5);
    EXPECT_DOUBLE_EQ(stats.levels[1].max, 2);
    EXPECT_DOUBLE_EQ(stats.all.total(), 8.0 / 7);
    EXPECT_DOUBLE_EQ(stats.sahCost, 1 + 10 * 3 / 5.0);
    EXPECT_DOUBLE_EQ(stats.exactSahCost, 1 + 10 * 2 / 5.0);
}

// Without an area there is no ratio. Neither infinity nor NaN may get into the means.
TEST(Slack, countsBoxesThatShouldHaveNoArea) {
    TwoSquares two;
    two.scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {4, 0, 0}, {5, 0, 0}, {4, 0, 0}};
    const SlackStats stats = slackStats(two.scene, two.bvh, {});
    EXPECT_EQ(stats.all.unbounded, 3u);
    EXPECT_EQ(stats.all.mean(), 1);
    EXPECT_EQ(stats.all.max, 1);
    Report report;
    addTo(report, stats);
    EXPECT_EQ(report["slack"]["unbounded"], 3);
    EXPECT_EQ(report["slack"]["levels"].size(), 2u);
    EXPECT_EQ(report.dump().find("inf"), std::string::npos);
}

TEST(Slack, isNoneForExactTrees) {
    const Scene scene = test::sceneOf(test::randomTriangles(500, 1, 0.3f));
    const SlackStats stats = slackStats(scene, buildSweep(scene, {}), {});
    EXPECT_EQ(stats.all.max, 1);
    EXPECT_EQ(stats.all.total(), 1);
    EXPECT_EQ(stats.sahCost, stats.exactSahCost);
}

// Boxes of split triangles are around their parts. With whole triangles slack would be less than 1.
TEST(Slack, ofSplitTrianglesIsThatOfTheirParts) {
    std::vector<Triangle> triangles = test::randomTriangles(1800, 1, 0.01f);
    for (const Triangle& t : test::randomTriangles(200, 1, 0.5f, 2))
        triangles.push_back({t.v0, t.v1, t.v1 * 0.99f + t.v2 * 0.01f});
    const Scene scene = test::sceneOf(triangles);
    const Bvh bvh = buildSpatial(scene, {});
    ASSERT_GT(bvh.primitives.size(), scene.triangles.size());
    const SlackStats stats = slackStats(scene, bvh, {});
    EXPECT_GE(stats.all.total(), 1);
    EXPECT_LT(stats.all.total(), 1.0001);
    for (const Slack& level : stats.levels) EXPECT_GE(level.mean(), 1);
    const Bvh decoded = decode(SshForm::encode(scene, bvh, {}));
    EXPECT_GT(slackStats(scene, decoded, {}).all.total(), 1.1);
}

}  // namespace
}  // namespace bvhio
