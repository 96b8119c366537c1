#include "relayout/order_effect.h"

#include <gtest/gtest.h>

#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

// Two pairs below the first pair's nodes. Half of the rays enter the left pair, and a quarter the right pair.
const std::vector<std::pair<uint32_t, uint32_t>> kEffectPairs{{0, 2}, {2, 4}, {3, 6}};
const PairWeights kEffectWeights{0, 4, 2, 1};

TEST(OrderEffect, isWorkedOutByHand) {
    LayoutOptions options;
    options.weights = kEffectWeights;
    options.recordBytes = 32;
    const OrderEffect effect = effectOf(test::treeOfPairs(kEffectPairs), {{2, 6, 4}}, options);
    EXPECT_EQ(effect.pairs, 3u);
    EXPECT_EQ(effect.moved, 2u);
    EXPECT_EQ(effect.recordBytes, 32u);
    EXPECT_EQ(effect.lines, 2u);
    EXPECT_EQ(effect.pages, 1u);
    EXPECT_EQ(effect.lineChanges.before, 0.25);
    EXPECT_EQ(effect.lineChanges.after, 0.5);
    EXPECT_EQ(effect.pageChanges.before, 0);
    EXPECT_EQ(effect.pageChanges.after, 0);
}

// Glue is fetched, too: a step by way of glue may change lines twice.
TEST(OrderEffect, goesThroughGlue) {
    LayoutOptions options;
    options.weights = kEffectWeights;
    options.lineSize = 16;
    LayoutResult layout{{2, 4, 6}};
    layout.slots = {2, 2, std::vector<uint32_t>{0, 2, SlotMap::kGlue | 1, SlotMap::kEmpty, 1}};
    const OrderEffect effect = effectOf(test::treeOfPairs(kEffectPairs), layout, options);
    EXPECT_EQ(effect.moved, 0u);
    EXPECT_EQ(effect.recordBytes, 8u);
    EXPECT_EQ(effect.lines, 3u);
    EXPECT_EQ(effect.lineChanges.before, 0.25);
    EXPECT_EQ(effect.lineChanges.after, 1);
}

TEST(OrderEffect, ofALeafIsNone) {
    const OrderEffect effect = effectOf(test::treeOfPairs({}), {}, {});
    EXPECT_EQ(effect.pairs, 0u);
    EXPECT_EQ(effect.lines, 0u);
    EXPECT_EQ(effect.lineChanges.after, 0);
}

// The purpose of pack.
TEST(OrderEffect, isWhatPackLowers) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs{{0, 2}};
    for (uint32_t i = 0; i < 254; ++i) pairs.emplace_back(2 + i, 4 + 2 * i);  // breadth first
    const Bvh tree = test::treeOfPairs(pairs);
    LayoutOptions options;
    options.weights.assign(tree.nodes.size() / 2, 1);
    for (size_t i = 2; i < tree.nodes.size(); ++i)
        if (!tree.nodes[i].isLeaf()) options.weights[tree.nodes[i].left() / 2] = options.weights[i / 2] / 2;
    const ExpectedChanges changes =
        effectOf(tree, choose(layouts(), "layout", "pack").function(tree, options), options).lineChanges;
    EXPECT_LT(changes.after, 0.6 * changes.before);
}

}  // namespace
}  // namespace bvhio
