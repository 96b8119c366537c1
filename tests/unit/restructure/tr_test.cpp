#include "restructure/tr.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstring>

#include "build/builders.h"
#include "common/random_treelet.h"
#include "common/test_scenes.h"
#include "core/error.h"

namespace bvhio {
namespace {

/// Returns the least cost of all trees, by trying every order of joins.
float leastCost(const std::vector<test::Subtree>& nodes, const TreeletCosts& costs) {
    if (nodes.size() == 1) return nodes[0].cost;
    float least = test::kNoLimit;
    for (size_t b = 1; b < nodes.size(); ++b)
        for (size_t a = 0; a < b; ++a) {
            std::vector<test::Subtree> joined = nodes;
            joined[a] = test::join(nodes[a], nodes[b], costs);
            joined.erase(joined.begin() + ptrdiff_t(b));
            least = std::min(least, leastCost(joined, costs));
        }
    return least;
}

constexpr TreeletCosts kCostsOfTr[] = {{1, 1, 0}, {1, 1, 4}, {1.2f, 1, 6}, {10, 1, 1000}, {1, 10, 1000}};

TEST(Tr, findsTheBestOfAllTrees) {
    for (uint32_t size = 3; size <= 6; ++size)
        for (uint64_t seed = 0; seed < 20; ++seed)
            for (const TreeletCosts& costs : kCostsOfTr) {
                SCOPED_TRACE(testing::Message() << size << " leaves, seed " << seed << ", costs "
                                                << costs.traversal << "/" << costs.intersection);
                const Treelet treelet = test::randomTreelet(size, seed, seed % 4 == 0);
                std::vector<test::Subtree> leaves;
                for (uint32_t i = 0; i < size; ++i) leaves.push_back(test::leafOf(treelet, i));
                TreeletPlan plan;
                ASSERT_TRUE(planOptimally(treelet, costs, test::kNoLimit, plan));
                const float least = leastCost(leaves, costs);
                EXPECT_NEAR(test::costOf(treelet, costs, plan), least, 1e-6 * least);
            }
}

TEST(Tr, plansTreeletsOfAnySize) {
    for (uint32_t size = 7; size <= kLargestOptimalTreelet; ++size)
        for (const TreeletCosts& costs : kCostsOfTr) {
            const Treelet treelet = test::randomTreelet(size, size, false);
            // Any other tree costs no less: that of one leaf less with the last put beside the root, say.
            Treelet smaller = treelet;
            --smaller.size;
            TreeletPlan plan, smallerPlan;
            ASSERT_TRUE(planOptimally(treelet, costs, test::kNoLimit, plan));
            ASSERT_TRUE(planOptimally(smaller, costs, test::kNoLimit, smallerPlan));
            test::Subtree rest = test::leafOf(treelet, 0);
            for (uint32_t i = 1; i < smaller.size; ++i)
                rest = test::join(rest, test::leafOf(treelet, i), costs);
            rest.cost = test::costOf(smaller, costs, smallerPlan);
            const float other = test::join(rest, test::leafOf(treelet, size - 1), costs).cost;
            EXPECT_LE(test::costOf(treelet, costs, plan), other);
        }
}

TEST(Tr, plansOnlyWhatCostsLess) {
    for (uint64_t seed = 0; seed < 10; ++seed)
        for (const TreeletCosts& costs : kCostsOfTr) {
            const Treelet treelet = test::randomTreelet(7, seed, seed % 2 == 0);
            TreeletPlan plan;
            ASSERT_TRUE(planOptimally(treelet, costs, test::kNoLimit, plan));
            const float cost = test::costOf(treelet, costs, plan);
            EXPECT_FALSE(planOptimally(treelet, costs, cost, plan));
            EXPECT_TRUE(planOptimally(treelet, costs, std::nextafter(cost, test::kNoLimit), plan));
        }
}

TEST(Tr, plansTheSameOnAnyProcessor) {
    for (uint32_t size = 3; size <= 9; ++size)
        for (uint64_t seed = 0; seed < 6; ++seed) {
            const Treelet treelet = test::randomTreelet(size, seed, seed % 2 == 0);
            TreeletPlan expected{};
            ASSERT_TRUE(planOptimally(treelet, kCostsOfTr[1], test::kNoLimit, expected));
            for (int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
                hwy::SetSupportedTargetsForTest(targets & -targets);
                hwy::GetChosenTarget().Update(hwy::SupportedTargets());
                TreeletPlan plan{};
                planOptimally(treelet, kCostsOfTr[1], test::kNoLimit, plan);
                EXPECT_EQ(std::memcmp(&plan, &expected, sizeof plan), 0)
                    << hwy::TargetName(targets & -targets) << ", " << size << " leaves, seed " << seed;
                hwy::SetSupportedTargetsForTest(0);
                hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            }
        }
}

TEST(Tr, refusesTreeletsThatTakeTooLong) {
    const Scene scene = test::sphereScene(8, 8);
    const Bvh bvh = builders()[0].function(scene, {});
    for (const uint32_t size : {1u, 2u, kLargestOptimalTreelet + 1}) {
        RestructureOptions options;
        options.treeletSize = size;
        EXPECT_THROW(restructureTr(scene, bvh, options), Error) << size;
    }
}

}  // namespace
}  // namespace bvhio
