#include "tree/connected_parts.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/random_tree.h"

namespace bvhio {
namespace {

/// Returns a random tree with random weights. A child's weight is at most its parent's.
std::vector<TreeItem> randomTree(uint32_t count, uint64_t seed) {
    Random random(seed);
    std::vector<TreeItem> items(count);
    items[0].weight = 1000;
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t parent = test::attachAtRandom(items, i, random);
        items[i].weight = double(random.below(uint32_t(items[parent].weight) + 1));
    }
    return items;
}

std::vector<uint32_t> parentsOf(const std::vector<TreeItem>& items) {
    std::vector<uint32_t> parents(items.size());
    for (uint32_t i = 0; i < items.size(); ++i)
        for (const uint32_t child : items[i].children)
            if (child != TreeItem::kNone) parents[child] = i;
    return parents;
}

/// Returns the sum of the weights of the items that start parts, by `first`; infinity if a part is too large.
double costOf(const std::vector<TreeItem>& items, const std::vector<uint32_t>& first, uint32_t maxSize) {
    std::vector<uint32_t> sizes(items.size(), 0);
    double sum = 0;
    for (uint32_t item = 0; item < items.size(); ++item) {
        if (++sizes[first[item]] > maxSize) return std::numeric_limits<double>::infinity();
        if (first[item] == item) sum += items[item].weight;
    }
    return sum;
}

/// Returns the least cost over all ways to cut the tree, where `within` keeps sets of items apart.
double leastCost(const std::vector<TreeItem>& items, uint32_t maxSize, const std::vector<uint32_t>& within) {
    const std::vector<uint32_t> parents = parentsOf(items);
    double least = std::numeric_limits<double>::infinity();
    std::vector<uint32_t> first(items.size(), 0);
    for (uint32_t cuts = 0; cuts < 1u << items.size(); cuts += 2) {
        for (uint32_t item = 1; item < items.size(); ++item) {
            const uint32_t parent = parents[item];
            const bool starts =
                (cuts >> item & 1) != 0 || (!within.empty() && within[item] != within[parent]);
            first[item] = starts ? item : first[parent];
        }
        least = std::min(least, costOf(items, first, maxSize));
    }
    return least;
}

TEST(ConnectedParts, costTheLeastThatAnyCutsDo) {
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        const std::vector<TreeItem> items = randomTree(uint32_t(2 + seed % 9), seed);
        const std::vector<uint32_t> parents = parentsOf(items);
        const std::vector<uint32_t> pages = ConnectedParts(items, 5).firstItems();
        for (const uint32_t maxSize : {1u, 2u, 3u, 4u, 100u})
            for (const std::vector<uint32_t>& within : {std::vector<uint32_t>(), pages}) {
                const ConnectedParts parts(items, maxSize, within);
                const std::vector<uint32_t> first = parts.firstItems();
                EXPECT_EQ(first[0], 0u);
                for (uint32_t item = 1; item < items.size(); ++item) {
                    if (first[item] == item) continue;
                    EXPECT_EQ(first[item], first[parents[item]]) << "not connected";
                    if (!within.empty()) {
                        EXPECT_EQ(within[item], within[first[item]]);
                    }
                }
                const double least = leastCost(items, maxSize, within);
                EXPECT_EQ(costOf(items, first, maxSize), least) << "seed " << seed << " size " << maxSize;
                EXPECT_EQ(items[0].weight + parts.cost(0, parts.bestSize(0)), least);
            }
    }
}

}  // namespace
}  // namespace bvhio
