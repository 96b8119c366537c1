#include "relayout/connected_clusters.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

/// A tree of so many pairs, each below a node that the ones before left free, with random weights.
PairTree randomTree(uint32_t pairs, uint64_t seed) {
    Random random(seed);
    std::vector<std::pair<uint32_t, uint32_t>> list;
    std::vector<uint32_t> leaves{0};
    PairWeights weights{1000};
    for (uint32_t left = 2; left < 2 * pairs + 2; left += 2) {
        std::swap(leaves[random.below(uint32_t(leaves.size()))], leaves.back());
        const uint32_t parent = leaves.back();
        leaves.pop_back();
        list.emplace_back(parent, left);
        weights.push_back(double(random.below(uint32_t(weights[parent / 2]) + 1)));
        leaves.insert(leaves.end(), {left, left + 1});
    }
    return {test::treeOfPairs(list), weights};
}

/// The sum of the weights of pairs that start clusters, which `top` names; infinite where one is too large.
double costOf(const PairTree& tree, const std::vector<uint32_t>& top, uint32_t maxSize) {
    std::vector<uint32_t> sizes(tree.size(), 0);
    double sum = 0;
    for (uint32_t pair = 0; pair < tree.size(); ++pair) {
        if (++sizes[top[pair]] > maxSize) return std::numeric_limits<double>::infinity();
        if (top[pair] == pair) sum += tree[pair].weight;
    }
    return sum;
}

/// The least cost over all ways to cut the tree, for sets of pairs that `within` keeps apart.
double leastCost(const PairTree& tree, uint32_t maxSize, const std::vector<uint32_t>& within) {
    double least = std::numeric_limits<double>::infinity();
    std::vector<uint32_t> top(tree.size(), 0);
    for (uint32_t cuts = 0; cuts < 1u << tree.size(); cuts += 2) {
        for (uint32_t pair = 1; pair < tree.size(); ++pair) {
            const uint32_t parent = tree[pair].parent;
            const bool starts =
                (cuts >> pair & 1) != 0 || (!within.empty() && within[pair] != within[parent]);
            top[pair] = starts ? pair : top[parent];
        }
        least = std::min(least, costOf(tree, top, maxSize));
    }
    return least;
}

TEST(ConnectedClusters, costTheLeastThatAnyCutsDo) {
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        const PairTree tree = randomTree(uint32_t(2 + seed % 9), seed);
        const std::vector<uint32_t> pages = connectedClusters(tree, 5);
        for (const uint32_t maxSize : {1u, 2u, 3u, 4u, 100u})
            for (const std::vector<uint32_t>& within : {std::vector<uint32_t>(), pages}) {
                const std::vector<uint32_t> top = connectedClusters(tree, maxSize, within);
                EXPECT_EQ(top[0], 0u);
                for (uint32_t pair = 1; pair < tree.size(); ++pair) {
                    if (top[pair] == pair) continue;
                    EXPECT_EQ(top[pair], top[tree[pair].parent]) << "not connected";
                    if (!within.empty()) {
                        EXPECT_EQ(within[pair], within[top[pair]]);
                    }
                }
                EXPECT_EQ(costOf(tree, top, maxSize), leastCost(tree, maxSize, within))
                    << "seed " << seed << " size " << maxSize;
            }
    }
}

}  // namespace
}  // namespace bvhio
