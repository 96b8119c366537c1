#include "restructure/atr.h"

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

constexpr TreeletCosts kCosts[] = {{1, 1, 0}, {1.2f, 1, 4}, {1, 10, 1000}};

/// Does the same agglomeration with all nodes in a list: in each round, nodes that are nearest to each other
/// are joined.
TreeletPlan planNaively(const Treelet& treelet, const TreeletCosts& costs) {
    struct Cluster {
        test::Subtree subtree;
        uint32_t node;
    };
    std::vector<Cluster> clusters;
    for (uint32_t i = 0; i < treelet.size; ++i) clusters.push_back({test::leafOf(treelet, i), i});
    TreeletPlan plan{};
    uint32_t step = 0;
    while (clusters.size() > 1) {
        std::vector<size_t> nearest(clusters.size());
        for (size_t a = 0; a < clusters.size(); ++a) {
            float least = test::kNoLimit;
            for (size_t b = 0; b < clusters.size(); ++b) {
                const test::Subtree &x = clusters[a].subtree, &y = clusters[b].subtree;
                const float distance = test::join(x, y, costs).area() - (0.5f * x.area() + 0.5f * y.area());
                if (a == b || !(distance < least)) continue;
                least = distance;
                nearest[a] = b;
            }
        }
        std::vector<Cluster> next;
        for (size_t a = 0; a < clusters.size(); ++a) {
            const size_t b = nearest[a];
            if (nearest[b] != a) {
                next.push_back(clusters[a]);
            } else if (a < b) {
                plan.left[step] = uint8_t(clusters[a].node);
                plan.right[step] = uint8_t(clusters[b].node);
                next.push_back(
                    {test::join(clusters[a].subtree, clusters[b].subtree, costs), treelet.size + step});
                ++step;
            }
        }
        clusters = next;
    }
    return plan;
}

TEST(Atr, agglomeratesAsTheNaiveWayDoes) {
    const int64_t supported = hwy::SupportedTargets();
    for (uint32_t size = 3; size <= kMaxTreeletSize; ++size)
        for (uint64_t seed = 0; seed < 12; ++seed)
            for (const TreeletCosts& costs : kCosts) {
                const Treelet treelet = test::randomTreelet(size, seed, seed % 3 == 0);
                const TreeletPlan expected = planNaively(treelet, costs);
                for (int64_t targets = supported; targets != 0; targets &= targets - 1) {
                    hwy::SetSupportedTargetsForTest(targets & -targets);
                    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
                    TreeletPlan plan{};
                    ASSERT_TRUE(planByAgglomeration(treelet, costs, test::kNoLimit, plan));
                    EXPECT_EQ(std::memcmp(&plan, &expected, sizeof plan), 0)
                        << hwy::TargetName(targets & -targets) << ", " << size << " leaves, seed " << seed;
                }
                hwy::SetSupportedTargetsForTest(0);
                hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            }
}

TEST(Atr, plansOnlyWhatCostsLess) {
    for (uint64_t seed = 0; seed < 10; ++seed)
        for (const TreeletCosts& costs : kCosts) {
            const Treelet treelet = test::randomTreelet(9, seed, seed % 2 == 0);
            TreeletPlan plan;
            ASSERT_TRUE(planByAgglomeration(treelet, costs, test::kNoLimit, plan));
            const float cost = test::costOf(treelet, costs, plan);
            EXPECT_FALSE(planByAgglomeration(treelet, costs, cost, plan));
            EXPECT_TRUE(planByAgglomeration(treelet, costs, std::nextafter(cost, test::kNoLimit), plan));
        }
}

TEST(Atr, refusesTreeletSizesOutOfRange) {
    const Scene scene = test::sphereScene(8, 8);
    const Bvh bvh = builders()[0].function(scene, {});
    for (const uint32_t size : {1u, 2u, kMaxTreeletSize + 1}) {
        RestructureOptions options;
        options.treeletSize = size;
        EXPECT_THROW(restructureAtr(scene, bvh, options), Error) << size;
    }
}

}  // namespace
}  // namespace bvhio
