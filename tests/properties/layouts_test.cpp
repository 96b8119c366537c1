// Tests every layout with trees of awkward scenes: it must move pairs of siblings, and change nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "relayout/clusters.h"
#include "stats/hashes.h"
#include "tree/sah_cost.h"

namespace bvhio {
namespace {

/// Returns weights unlike areas: random, but at most the parent's.
PairWeights randomWeights(const Bvh& bvh, uint64_t seed) {
    Random random(seed);
    PairWeights weights(bvh.nodes.size() / 2, 1000);
    for (size_t i = 0; i < bvh.nodes.size(); ++i)
        if (i != 1 && !bvh.nodes[i].isLeaf())
            weights[bvh.nodes[i].left() / 2] = double(random.below(uint32_t(weights[i / 2]) + 1));
    return weights;
}

/// Returns the weights of the same pairs in another order. Pairs are matched by walking both trees side by
/// side.
PairWeights weightsIn(const Bvh& to, const Bvh& from, const PairWeights& weights) {
    PairWeights moved(weights.size(), weights[0]);
    std::vector<std::pair<uint32_t, uint32_t>> stack{{0, 0}};
    while (!stack.empty()) {
        const auto [a, b] = stack.back();
        stack.pop_back();
        if (to.nodes[a].isLeaf()) continue;
        moved[to.nodes[a].left() / 2] = weights[from.nodes[b].left() / 2];
        for (const uint32_t side : {0u, 1u})
            stack.emplace_back(to.nodes[a].first + side, from.nodes[b].first + side);
    }
    return moved;
}

std::vector<LayoutOptions> settings() {
    std::vector<LayoutOptions> all(1);
    all.push_back({.lineSize = 64, .recordBytes = 8, .threshold = 0, .treeletSize = 3, .pointerBits = 3});
    all.push_back({.lineSize = 128, .recordBytes = 48, .threshold = 1, .treeletSize = 1, .pointerBits = 4});
    all.push_back({.lineSize = 16, .recordBytes = 64, .threshold = 0.5f, .treeletSize = 1000});
    return all;
}

std::vector<std::pair<const test::TestScene*, std::string_view>> scenesAndBuilders() {
    std::vector<std::pair<const test::TestScene*, std::string_view>> all;
    for (const test::TestScene& scene : test::testScenes())
        for (const std::string_view builder : {"binned", "spatial"}) all.emplace_back(&scene, builder);
    return all;
}

class EveryLayout : public testing::TestWithParam<Layout> {};

// If a pair is missing, listed twice, or before its parent, readers reject the file.
TEST_P(EveryLayout, movesPairsBehindTheirParentsAndChangesNothingElse) {
    for (const auto& [testScene, builder] : scenesAndBuilders()) {
        const Scene scene = testScene->make();
        const Bvh before =
            choose(builders(), "builder", builder).function(scene, {.costs = {}, .maxLeafSize = 1});
        for (LayoutOptions options : settings())
            for (const uint64_t seed : {0, 1, 2}) {
                if (seed > 0) options.weights = randomWeights(before, seed);
                SCOPED_TRACE(testing::Message()
                             << testScene->name << " " << builder << " lines " << options.lineSize
                             << " records " << options.recordBytes << " weights " << seed);
                const LayoutResult result = GetParam().function(before, options);
                std::vector<uint32_t> place(before.nodes.size() / 2, 0);
                ASSERT_EQ(result.order.size(), place.size() - 1);
                for (uint32_t i = 0; i < result.order.size(); ++i) {
                    ASSERT_LT(result.order[i], before.nodes.size());
                    ASSERT_EQ(result.order[i] % 2, 0u);
                    ASSERT_EQ(std::exchange(place[result.order[i] / 2], i + 1), 0u) << "listed twice";
                }
                for (uint32_t i = 0; i < before.nodes.size(); ++i) {
                    if (i == 1 || before.nodes[i].isLeaf()) continue;
                    ASSERT_LT(place[i / 2], place[before.nodes[i].left() / 2]) << "before its parent";
                }

                const Bvh after = applyLayout(before, result);
                if (!after.slots.empty()) {
                    EXPECT_EQ(validateSlots(after), "");
                }
                ASSERT_NO_FATAL_FAILURE(test::expectValid(scene, after, kMaxLeafSize));
                EXPECT_EQ(topologyHash(after), topologyHash(before));
                EXPECT_EQ(boundsHash(after), boundsHash(before));
                EXPECT_NEAR(sahCost(after, {}), sahCost(before, {}), 1e-9 * sahCost(before, {}));
            }
    }
}

// Otherwise the order would change each time a pipeline is run on its own output.
TEST_P(EveryLayout, givesOneOrderWhateverTheOldOne) {
    for (const test::TestScene& testScene : test::testScenes()) {
        SCOPED_TRACE(testScene.name);
        const Scene scene = testScene.make();
        const Bvh before = builders().front().function(scene, {.costs = {}, .maxLeafSize = 2});
        const Bvh shuffled = test::shuffledTree(before, 5, false);
        for (LayoutOptions options : settings())
            for (const uint64_t seed : {0, 1}) {
                if (seed > 0) options.weights = randomWeights(before, seed);
                const Bvh once = applyNodeOrder(before, GetParam().function(before, options).order);
                LayoutOptions again = options, fromShuffled = options;
                if (seed > 0) {
                    again.weights = weightsIn(once, before, options.weights);
                    fromShuffled.weights = weightsIn(shuffled, before, options.weights);
                }
                EXPECT_TRUE(
                    test::sameBytes(once, applyNodeOrder(once, GetParam().function(once, again).order)));
                const Bvh other = applyNodeOrder(shuffled, GetParam().function(shuffled, fromShuffled).order);
                EXPECT_TRUE(test::sameBytes(once, other));
            }
    }
}

INSTANTIATE_TEST_SUITE_P(, EveryLayout, testing::ValuesIn(layouts().begin(), layouts().end()),
                         [](const auto& test) {
                             std::string name(test.param.name);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace bvhio
