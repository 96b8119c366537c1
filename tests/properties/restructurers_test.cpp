// Tests every restructurer with every builder's trees of awkward scenes: it must keep the invariants of
// tree/bvh.h, and never raise the cost.
#include "restructure/restructurers.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <string>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "scene/triangle_bounds.h"
#include "tree/validate.h"

namespace bvhio {
namespace {

struct Case {
    const Restructurer* restructurer;
    const test::TestScene* scene;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.restructurer->name << " " << c.scene->name;
}

std::vector<Case> allCases() {
    std::vector<Case> cases;
    for (const Restructurer& restructurer : restructurers())
        for (const test::TestScene& scene : test::testScenes()) cases.push_back({&restructurer, &scene});
    return cases;
}

/// Compares a result with the tree that it was made from.
void expectBetter(const Scene& scene, const Bvh& before, const Bvh& after,
                  const RestructureOptions& options) {
    ASSERT_NO_FATAL_FAILURE(test::expectValid(scene, after, kMaxLeafSize));
    EXPECT_LE(sahCost(after, options.costs), sahCost(before, options.costs));
    EXPECT_EQ(after.nodes[0].bounds, before.nodes[0].bounds);
    // References may be joined, but never added.
    EXPECT_LE(after.primitives.size(), before.primitives.size());
    if (!options.collapse) {
        EXPECT_EQ(after.nodes.size(), before.nodes.size());
        EXPECT_EQ(after.primitives.size(), before.primitives.size());
    }
    for (const Finding& finding :
         validate(after, uint32_t(scene.triangles.size()), boundsOfTriangles(scene)).findings)
        ADD_FAILURE() << finding.message;
}

class EveryRestructurer : public testing::TestWithParam<Case> {};

TEST_P(EveryRestructurer, keepsTheInvariantsAndLowersTheCost) {
    const auto& [restructurer, testScene] = GetParam();
    const Scene scene = testScene->make();
    struct Setting {
        uint32_t leafSize;
        SahCosts costs;
        bool collapse;
    };
    static constexpr Setting kSettings[] = {{1, {}, true},
                                            {1, {1, 1}, false},
                                            {4, {1, 1}, true},
                                            {4, {1, 1000}, false},
                                            {4, {1000, 1}, true},
                                            {kMaxLeafSize, {1000, 1}, true},
                                            {kMaxLeafSize, {}, false}};
    for (const Builder& builder : builders())
        for (const auto& [leafSize, costs, collapse] : kSettings) {
            SCOPED_TRACE(testing::Message()
                         << builder.name << " leaf " << leafSize << " costs " << costs.traversal << "/"
                         << costs.intersection << (collapse ? "" : " not collapsed"));
            const Bvh before = builder.function(scene, {.costs = costs, .maxLeafSize = leafSize});
            RestructureOptions options;
            options.costs = costs;
            options.collapse = collapse;
            const Restructured result = restructurer->function(scene, before, options);
            ASSERT_NO_FATAL_FAILURE(expectBetter(scene, before, result.bvh, options));
        }
}

TEST_P(EveryRestructurer, takesItsOptionsAtTheirLimits) {
    const auto& [restructurer, testScene] = GetParam();
    const Scene scene = testScene->make();
    const Bvh before = test::shuffledTree(builders()[0].function(scene, {.costs = {}}), 7);
    for (const auto& [treeletSize, gamma] : {std::pair{0u, 0u}, {3u, 1u}, {4u, 100u}, {8u, 3u}})
        for (const uint32_t maxLeafSize : {0u, 1u, kMaxLeafSize}) {
            RestructureOptions options;
            options.treeletSize = treeletSize;
            options.gamma = gamma;
            options.iterations = 2;
            options.maxLeafSize = maxLeafSize;
            options.recordCosts = true;
            const Restructured result = restructurer->function(scene, before, options);
            ASSERT_NO_FATAL_FAILURE(expectBetter(scene, before, result.bvh, options));
            // The last recorded cost is the result's, unless the given tree was cheaper.
            if (result.iterations.empty()) continue;
            EXPECT_NEAR(sahCost(result.bvh, options.costs),
                        std::min(result.iterations.back().sahCost, sahCost(before, options.costs)),
                        1e-6 * sahCost(before, options.costs));
        }
}

INSTANTIATE_TEST_SUITE_P(, EveryRestructurer, testing::ValuesIn(allCases()), [](const auto& test) {
    return std::string(test.param.restructurer->name) + "_" + test.param.scene->name;
});

class RestructurerOverManyTriangles : public testing::TestWithParam<const Restructurer*> {};

TEST_P(RestructurerOverManyTriangles, givesTheSameBytesWithAnyNumberOfThreads) {
    const Scene scene = test::sceneOf(test::randomTriangles(60000, 1, 0.02f));
    const Bvh before = builders()[0].function(scene, {});
    Bvh first;
    for (const size_t threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        const RestructureOptions options;
        Bvh bvh = GetParam()->function(scene, before, options).bvh;
        if (threads == 1) {
            expectBetter(scene, before, bvh, options);
            first = std::move(bvh);
        } else {
            EXPECT_TRUE(test::sameBytes(first, bvh)) << threads << " threads";
        }
    }
}

// If areas differed on one processor, places and treelets would be chosen differently.
TEST_P(RestructurerOverManyTriangles, givesTheSameBytesOnEveryProcessor) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.05f));
    const Bvh before = builders()[0].function(scene, {});
    const Bvh expected = GetParam()->function(scene, before, {}).bvh;
    const int64_t supported = hwy::SupportedTargets();
    for (int64_t targets = supported; targets != 0; targets &= targets - 1) {
        hwy::SetSupportedTargetsForTest(targets & -targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_TRUE(test::sameBytes(expected, GetParam()->function(scene, before, {}).bvh))
            << hwy::TargetName(targets & -targets);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::vector<const Restructurer*> allRestructurers() {
    std::vector<const Restructurer*> all;
    for (const Restructurer& restructurer : restructurers()) all.push_back(&restructurer);
    return all;
}
INSTANTIATE_TEST_SUITE_P(, RestructurerOverManyTriangles, testing::ValuesIn(allRestructurers()),
                         [](const auto& test) { return std::string(test.param->name); });

}  // namespace
}  // namespace bvhio
