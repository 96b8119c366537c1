// Tests properties that the statistics of every builder's tree over any scene must have.
#include <gtest/gtest.h>

#include "build/builders.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "core/report.h"
#include "stats/diff.h"
#include "stats/slack.h"
#include "stats/stats_report.h"
#include "stats/tree_stats.h"

namespace bvhio {
namespace {

template <class Check>
void forEveryTree(const Check& check) {
    for (const Builder& builder : builders())
        for (const test::TestScene& row : test::testScenes()) {
            SCOPED_TRACE(std::string(builder.name) + " of " + row.name);
            const Scene scene = row.make();
            check(scene, builder.function(scene, {}));
        }
}

TEST(StatsProperties, theNumbersAddUp) {
    forEveryTree([](const Scene& scene, const Bvh& bvh) {
        const SahCosts costs;
        const TreeStats stats = treeStats(bvh, costs);
        EXPECT_GE(stats.references, scene.triangles.size());
        EXPECT_EQ(stats.nodes, stats.innerNodes + stats.leaves);
        EXPECT_EQ(stats.leaves, stats.innerNodes + 1);
        EXPECT_LE(stats.maxDepth, kMaxDepth);
        EXPECT_LE(stats.averageLeafDepth, stats.maxDepth);
        uint64_t leaves = 0, references = 0;
        for (const uint64_t count : stats.leafDepths) leaves += count;
        EXPECT_EQ(leaves, stats.leaves);
        for (size_t size = 0; size < stats.leafSizes.size(); ++size)
            references += size * stats.leafSizes[size];
        EXPECT_EQ(references, stats.references);
        EXPECT_NEAR(stats.sahCost,
                    costs.traversal * stats.expectedInnerNodes + costs.intersection * stats.expectedTriangles,
                    1e-9 * stats.sahCost);
        EXPECT_GE(stats.childOverlap, 0);
        EXPECT_LE(stats.childOverlap, 1);
    });
}

TEST(StatsProperties, epoIsFiniteAndAtMostWhatEveryNodeAroundEveryTriangleWouldCost) {
    forEveryTree([](const Scene& scene, const Bvh& bvh) {
        const SahCosts costs;
        const TreeStats stats = treeStats(bvh, costs);
        const double found = epo(scene, bvh, costs).value;
        EXPECT_GE(found, 0);
        EXPECT_LE(found,
                  costs.traversal * double(stats.innerNodes) + costs.intersection * double(stats.references));
    });
}

TEST(StatsProperties, aRearrangedTreeDiffersInOrderAlone) {
    forEveryTree([](const Scene& scene, const Bvh& bvh) {
        const Bvh shuffled = test::shuffledTree(bvh, 5);
        const EncodedBvh a = AabbForm(bvh), b = AabbForm(shuffled);
        for (const Difference& difference : differences({scene, a}, {scene, b}))
            EXPECT_EQ(difference.aspect, Aspect::order) << difference.first;
        const double epoA = epo(scene, bvh, {}).value, epoB = epo(scene, shuffled, {}).value;
        EXPECT_NEAR(epoA, epoB, 1e-12 * epoA);
    });
}

TEST(StatsProperties, theReportIsTheSameForAnyNumberOfThreads) {
    forEveryTree([](const Scene& scene, const Bvh& bvh) {
        const EncodedBvh encoded = AabbForm(bvh);
        for (const uint64_t exactUpTo : {uint64_t(0), ~uint64_t(0)}) {
            const StatsOptions options{.costs = {},
                                       .epo = EpoOptions{.exactUpTo = exactUpTo, .samples = 200}};
            std::string one;
            {
                const ThreadLimit limit(1);
                one = statsReport(scene, encoded, options).dump();
            }
            const ThreadLimit limit(4);
            EXPECT_EQ(statsReport(scene, encoded, options).dump(), one);
        }
    });
}

TEST(StatsProperties, noBoxIsSmallerThanTheExactOne) {
    forEveryTree([](const Scene& scene, const Bvh& bvh) {
        for (const FormChoice& form : forms()) {
            SCOPED_TRACE(form.name);
            const SlackStats stats = slackStats(scene, decode(form.function(scene, bvh, {})), {});
            EXPECT_GE(stats.all.area, stats.all.exactArea);
            uint64_t nodes = 0;
            for (const Slack& level : stats.levels) {
                EXPECT_GE(level.mean(), 1);
                EXPECT_GE(level.max, level.mean() * (1 - 1e-12));
                nodes += level.nodes;
            }
            EXPECT_EQ(nodes, stats.all.nodes);
        }
    });
}

}  // namespace
}  // namespace bvhio
