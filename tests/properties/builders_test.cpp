// Tests the invariants of tree/bvh.h for every builder, over awkward scenes and options.
#include "build/builders.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <chrono>
#include <cmath>
#include <string>

#include "common/expect_valid.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

/// A builder and a scene; the name of the test is then "properties/binned_huge".
struct Case {
    const Builder* builder;
    const test::TestScene* scene;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.builder->name << " " << c.scene->name;
}

std::vector<Case> allCases() {
    std::vector<Case> cases;
    for (const Builder& builder : builders())
        for (const test::TestScene& scene : test::testScenes()) cases.push_back({&builder, &scene});
    return cases;
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
    return std::string(info.param.builder->name) + "_" + info.param.scene->name;
}

class EveryBuilder : public testing::TestWithParam<Case> {};

TEST_P(EveryBuilder, keepsTheInvariantsWithAnyOptions) {
    const auto& [builder, testScene] = GetParam();
    const Scene scene = testScene->make();
    for (const uint32_t maxLeafSize : {1u, 2u, 4u, 16u, kMaxLeafSize})
        for (const uint32_t bins : {0u, 2u, 7u, 64u})
            for (const SahCosts costs : {SahCosts{}, SahCosts{1, 1}, SahCosts{1000, 1}, SahCosts{1, 1000}}) {
                SCOPED_TRACE(testing::Message() << "leaf " << maxLeafSize << " bins " << bins << " costs "
                                                << costs.traversal << "/" << costs.intersection);
                const Bvh bvh = builder->function(scene, {costs, bins, maxLeafSize});
                ASSERT_NO_FATAL_FAILURE(test::expectValid(scene, bvh, maxLeafSize));
                ASSERT_TRUE(std::isfinite(sahCost(bvh, costs)));
            }
}

INSTANTIATE_TEST_SUITE_P(, EveryBuilder, testing::ValuesIn(allCases()), nameOf);

class LargeScenes : public testing::TestWithParam<const Builder*> {};

/// Returns a scene above the sizes from which builders share the work of one node among threads.
Scene largeSoup() {
    return test::sceneOf(test::randomTriangles(150000, 1, 0.01f));
}

TEST_P(LargeScenes, giveTheSameBytesWithAnyNumberOfThreads) {
    const Scene scene = largeSoup();
    Bvh first;
    for (const size_t threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        Bvh bvh = GetParam()->function(scene, {});
        if (threads == 1) {
            test::expectValid(scene, bvh, 4);
            first = std::move(bvh);
        } else {
            EXPECT_TRUE(test::sameBytes(first, bvh)) << threads << " threads";
        }
    }
}

TEST_P(LargeScenes, giveTheSameBytesOnEveryProcessor) {
    // Not larger, because with sanitizers the most basic target is very slow.
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.02f));
    const Bvh expected = GetParam()->function(scene, {});
    const int64_t supported = hwy::SupportedTargets();
    for (int64_t targets = supported; targets != 0; targets &= targets - 1) {
        hwy::SetSupportedTargetsForTest(targets & -targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_TRUE(test::sameBytes(expected, GetParam()->function(scene, {})))
            << hwy::TargetName(targets & -targets);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// No plane splits these triangles. A builder that took off one primitive at a time would need minutes.
TEST_P(LargeScenes, withAMillionCoincidentCentroidsAreHalvedQuickly) {
    const Scene scene = test::coincidentScene(1000000);
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = GetParam()->function(scene, {});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    test::expectValid(scene, bvh, 4);
    // Halving 10^6 down to leaves of 4 takes 18 levels.
    EXPECT_LE(depthOf(bvh), 22u);
}

// Object medians ignore areas, so builders that use them must do better on surfaces.
TEST_P(LargeScenes, costNoMoreThanMedianSplits) {
    const auto median = choose(builders(), "builder", "median").function;
    for (const Scene& scene : {test::sphereScene(200, 100), largeSoup(),
                               test::gridScene(150, [](float x, float y) { return float(int(x * y) % 7); })})
        EXPECT_LE(sahCost(GetParam()->function(scene, {}), {}), sahCost(median(scene, {}), {}));
}

std::vector<const Builder*> allBuilders() {
    std::vector<const Builder*> all;
    for (const Builder& builder : builders()) all.push_back(&builder);
    return all;
}
std::string builderNameOf(const testing::TestParamInfo<const Builder*>& info) {
    return std::string(info.param->name);
}
INSTANTIATE_TEST_SUITE_P(, LargeScenes, testing::ValuesIn(allBuilders()), builderNameOf);

}  // namespace
}  // namespace bvhio
