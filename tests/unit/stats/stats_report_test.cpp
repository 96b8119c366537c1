#include "stats/stats_report.h"

#include <gtest/gtest.h>

#include "build/median.h"
#include "common/test_scenes.h"
#include "core/report.h"
#include "stats/hashes.h"

namespace bvhio {
namespace {

TEST(StatsReport, hasTheKeysThatOthersRead) {
    const Scene scene = test::sceneOf(test::randomTriangles(100, 1, 0.2f));
    const Bvh bvh = buildMedian(scene, {});
    const Report report = statsReport(scene, AabbForm(bvh), {});
    for (const char* key : {"form",
                            "layout",
                            "primitives",
                            "references",
                            "nodes",
                            "inner_nodes",
                            "leaves",
                            "max_depth",
                            "sah_cost",
                            "traversal_cost",
                            "intersection_cost",
                            "epo",
                            "epo_exact",
                            "epo_sampled_triangles",
                            "epo_standard_error",
                            "bytes",
                            "bytes_per_primitive",
                            "topology_hash",
                            "bounds_hash",
                            "geometry_hash"})
        EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_EQ(report["form"], "aabb");
    EXPECT_EQ(report["layout"], "dfs");
    EXPECT_EQ(report["primitives"], 100);
    EXPECT_EQ(report["topology_hash"], hashText(topologyHash(bvh)));
}

TEST(StatsReport, writesCostsAsTheyWereGiven) {
    // As a double, 1.2f is 1.2000000476837158.
    const Scene scene = test::sceneOf(test::randomTriangles(9, 1, 0.2f));
    const Report report = statsReport(scene, AabbForm(buildMedian(scene, {})), {});
    EXPECT_EQ(report["traversal_cost"].dump(), "1.2");
}

TEST(StatsReport, leavesOutEpoWhenTold) {
    const Scene scene = test::sceneOf(test::randomTriangles(9, 1, 0.2f));
    const Report report =
        statsReport(scene, AabbForm(buildMedian(scene, {})), {.costs = {}, .epo = std::nullopt});
    EXPECT_FALSE(report.contains("epo"));
    EXPECT_FALSE(report.contains("epo_exact"));
}

TEST(HashText, keepsLeadingZeros) {
    EXPECT_EQ(hashText(0xABC), "0000000000000abc");
}

}  // namespace
}  // namespace bvhio
