#include "tree/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "build/builders.h"
#include "common/random_tree.h"
#include "common/test_scenes.h"
#include "tree/cluster_cuts.h"
#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

SlotStats clusteredStats(Bvh bvh, const ClusterOptions& options) {
    bvh.slots = makeClusters(bvh, options);
    EXPECT_EQ(validateSlots(bvh), "");
    return statsOf(bvh.slots);
}

// With a pointer out of reach, a record before its parent's, or a missing pair, a tree cannot be traced.
TEST(Clusters, ofAnySizeHaveEveryPairInReach) {
    for (const test::TestScene& testScene : test::testScenes()) {
        const Scene scene = testScene.make();
        for (const uint32_t maxLeafSize : {1u, 8u}) {
            const Bvh bvh = builders()[0].function(scene, {.costs = {1, 1}, .maxLeafSize = maxLeafSize});
            for (const ClusterMethod method : {ClusterMethod::cheapest, ClusterMethod::paper})
                for (const uint32_t pointerBits : {2u, 3u, 4u, 6u, 10u})
                    for (const uint32_t lineSlots : {1u, 2u, 8u, 64u}) {
                        SCOPED_TRACE(testing::Message() << testScene.name << ' ' << pointerBits << " bits "
                                                        << lineSlots << " a line");
                        if (bvh.nodes.size() == 2) {
                            EXPECT_TRUE(makeClusters(bvh, {pointerBits, lineSlots, method}).empty());
                            continue;
                        }
                        const SlotStats stats = clusteredStats(bvh, {pointerBits, lineSlots, method});
                        EXPECT_EQ(stats.records, bvh.nodes.size() / 2 - 1);
                        // With longer lines a cut may save padding.
                        if (method == ClusterMethod::cheapest && lineSlots == 1 &&
                            stats.records <= 1u << pointerBits &&
                            bvh.primitives.size() <= SlotMap::maxEntries(pointerBits)) {
                            EXPECT_EQ(stats.clusters, 1u);
                        }
                    }
        }
    }
}

// Tests the deepest chains, to either side.
TEST(Clusters, holdTheDeepestChains) {
    for (const uint32_t side : {0u, 1u}) {
        std::vector<std::pair<uint32_t, uint32_t>> pairs{{0, 2}};
        while (pairs.size() < kMaxDepth)
            pairs.emplace_back(pairs.back().second + side, pairs.back().second + 2);
        const SlotStats stats = clusteredStats(test::treeOfPairs(pairs), {6, 8, {}});
        EXPECT_EQ(stats.clusters, 2u);
    }
}

/// Returns the largest number of entries that the leaves of a cluster own.
uint32_t mostEntries(Bvh bvh, const ClusterOptions& options) {
    bvh.slots = makeClusters(bvh, options);
    std::vector<bool> starts(bvh.nodes.size() / 2 - 1);
    for (const uint32_t word : bvh.slots.words)
        if (word != SlotMap::kEmpty && (word & SlotMap::kGlue) != 0) starts[word & ~SlotMap::kGlue] = true;
    uint32_t most = 0, entries = 0;
    for (const uint32_t word : bvh.slots.words) {
        if ((word & SlotMap::kGlue) != 0) continue;
        if (starts[word]) entries = 0;
        for (const uint32_t child : {0u, 1u}) entries += bvh.nodes[2 * word + 2 + child].primitiveCount;
        most = std::max(most, entries);
    }
    return most;
}

// The entries of leaves must be in reach, too. Here there are more than 2^11 - 2^8.
TEST(Clusters, countTheEntriesOfLeaves) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs{{0, 2}};
    for (uint32_t i = 0; i < 63; ++i) pairs.emplace_back(2 + i, 4 + 2 * i);
    Bvh bvh = test::treeOfPairs(pairs);
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    uint32_t entries = 0;
    for (Node& node : nodes)
        if (node.isLeaf()) {
            node.first = entries;
            entries += node.primitiveCount = 32;
        }
    bvh.nodes = std::move(nodes);
    EXPECT_GT(entries, SlotMap::maxEntries(8));
    for (const ClusterMethod method : {ClusterMethod::cheapest, ClusterMethod::paper}) {
        EXPECT_LE(mostEntries(bvh, {8, 8, method}), SlotMap::maxEntries(8));
        EXPECT_GT(mostEntries(bvh, {8, 8, method}), SlotMap::maxEntries(8) / 3);
    }
}

TEST(Clusters, spendLittleAndLessWithMoreBits) {
    const Scene scene = test::sphereScene(80, 40);
    const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});
    double glue = 1, bytes = 10;
    for (const auto& [bits, mostGlue, mostBytes] :
         {std::tuple{6u, 0.04, 9.8}, {8u, 0.012, 9.0}, {10u, 0.004, 8.6}}) {
        const SlotStats stats = clusteredStats(bvh, {bits, 8, {}});
        EXPECT_LE(stats.glueShare(), mostGlue) << bits;
        EXPECT_LT(stats.glueShare(), glue) << bits;
        const double bytesOfRecord = 8 * double(stats.slots) / double(stats.records);
        EXPECT_LE(bytesOfRecord, mostBytes) << bits;
        EXPECT_LT(bytesOfRecord, bytes) << bits;
        glue = stats.glueShare();
        bytes = bytesOfRecord;
    }
    EXPECT_GT(clusteredStats(bvh, {6, 8, ClusterMethod::paper}).glueShare(), 0.04);
}

/// Returns the cost that tree/cluster_cuts.h minimises; infinity if a cluster is too large.
double costOfCuts(const std::vector<ClusterPair>& pairs, const ClusterLimits& limits) {
    double sum = 0, cost = 0;
    for (const ClusterPair& pair : pairs) sum += pair.weight;
    std::vector<uint32_t> slots(pairs.size());
    for (size_t p = pairs.size(); p-- > 0;) {
        ++slots[p];
        for (const uint32_t child : pairs[p].children)
            if (child != ClusterPair::kNone) slots[p] += pairs[child].isCut ? 1 : slots[child];
        if (slots[p] > limits.slots) return std::numeric_limits<double>::infinity();
        if (pairs[p].isCut) cost += pairs[p].weight * double(pairs.size()) / sum + 1;
        if (pairs[p].isCut || p == 0)
            cost += (limits.lineSlots - slots[p] % limits.lineSlots) % limits.lineSlots;
    }
    return cost;
}

TEST(ClusterCuts, costTheLeastOfAllCuts) {
    Random random(3);
    for (int round = 0; round < 60; ++round) {
        std::vector<ClusterPair> pairs(1 + random.below(10));
        pairs[0].weight = 64;
        for (uint32_t p = 1; p < pairs.size(); ++p) {
            const uint32_t parent = test::attachAtRandom(pairs, p, random);
            pairs[p].weight = pairs[parent].weight * double(1 + random.below(4)) / 4;
        }
        const ClusterLimits limits{4 + random.below(3), 1000, 1u << random.below(3)};
        double least = std::numeric_limits<double>::infinity();
        for (uint32_t cuts = 0; cuts < 1u << pairs.size(); cuts += 2) {
            for (uint32_t p = 1; p < pairs.size(); ++p) pairs[p].isCut = (cuts >> p & 1) != 0;
            least = std::min(least, costOfCuts(pairs, limits));
        }
        cutAtLeastCost(pairs, limits);
        EXPECT_NEAR(costOfCuts(pairs, limits), least, 1e-4) << round;
    }
}

}  // namespace
}  // namespace bvhio
