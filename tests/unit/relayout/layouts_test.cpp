// Tests layouts with trees so small that their orders can be written out.
#include "relayout/layouts.h"

#include <gtest/gtest.h>

#include "build/binned.h"
#include "common/test_scenes.h"
#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

NodeOrder orderOf(std::string_view layout, const Bvh& bvh, const LayoutOptions& options = {}) {
    return choose(layouts(), "layout", layout).function(bvh, options).order;
}

// The pairs, by their left nodes: 2 below the root; 4 and 6 below 2 and 3; 8 below 4; 10 and 12 below 6
// and 7.
//            2
//       4         6
//     8         10  12
Bvh sixPairs() {
    return test::treeOfPairs({{0, 2}, {2, 4}, {3, 6}, {4, 8}, {6, 10}, {7, 12}});
}
// The right side is likelier everywhere except below 6.
const PairWeights kWeights{10, 10, 3, 7, 2, 4, 3};

TEST(Layouts, dfsPutsALeftSubtreeBeforeTheRightOne) {
    EXPECT_EQ(orderOf("dfs", sixPairs()), (NodeOrder{2, 4, 8, 6, 10, 12}));
}

TEST(Layouts, odfsPutsTheLikelierSubtreeFirst) {
    EXPECT_EQ(orderOf("odfs", sixPairs(), {.weights = kWeights}), (NodeOrder{2, 6, 10, 12, 4, 8}));
}

TEST(Layouts, bfsGoesLevelByLevel) {
    EXPECT_EQ(orderOf("bfs", sixPairs()), (NodeOrder{2, 4, 6, 8, 10, 12}));
}

TEST(Layouts, swstIsOdfs) {
    EXPECT_EQ(orderOf("swst", sixPairs(), {.weights = kWeights}),
              orderOf("odfs", sixPairs(), {.weights = kWeights}));
}

TEST(Layouts, vebPutsTheUpperHalfFirst) {
    // Four levels: pair k, whose left node is 2k, has pairs 2k and 2k + 1 below it.
    std::vector<std::pair<uint32_t, uint32_t>> pairs{{0, 2}};
    for (uint32_t node = 2; node < 16; ++node) pairs.emplace_back(node, 2 * node);
    EXPECT_EQ(orderOf("veb", test::treeOfPairs(pairs)),
              (NodeOrder{2, 4, 6, 8, 16, 18, 10, 20, 22, 12, 24, 26, 14, 28, 30}));
}

// A child below the threshold must become the root of a treelet, not disappear. The likeliest of these
// follows at once.
TEST(Layouts, tdfsFollowsLikelyChildrenDown) {
    const LayoutOptions options{.threshold = 0.5f, .weights = kWeights};
    EXPECT_EQ(orderOf("tdfs", sixPairs(), options), (NodeOrder{2, 6, 10, 4, 8, 12}));
    // All children are likely enough, but two pairs fill a treelet.
    const LayoutOptions ofTwo{.threshold = 0, .treeletSize = 2, .weights = {10, 10, 6, 7, 5, 4, 3}};
    EXPECT_EQ(orderOf("tdfs", sixPairs(), ofTwo), (NodeOrder{2, 6, 4, 8, 10, 12}));
}

TEST(Layouts, tbfsGoesThroughTreeletsByLevel) {
    const LayoutOptions options{.threshold = 0, .treeletSize = 3, .weights = kWeights};
    EXPECT_EQ(orderOf("tbfs", sixPairs(), options), (NodeOrder{2, 6, 4, 10, 12, 8}));
    const LayoutOptions aLine{.lineSize = 48, .recordBytes = 16, .threshold = 0, .weights = kWeights};
    EXPECT_EQ(orderOf("tbfs", sixPairs(), aLine), (NodeOrder{2, 6, 4, 10, 12, 8}));
}

TEST(Layouts, colPutsTheLikeliestPartFirst) {
    EXPECT_EQ(orderOf("col", sixPairs(), {.weights = kWeights}), (NodeOrder{2, 6, 10, 4, 8, 12}));
}

// 2 with 6 and 4 with 8 leave the fewest crossings. 10 and 12 are alone, so 12 completes the line of 10.
TEST(Layouts, packFillsLinesWithConnectedPairs) {
    const LayoutOptions options{.lineSize = 32, .recordBytes = 16, .weights = kWeights};
    EXPECT_EQ(orderOf("pack", sixPairs(), options), (NodeOrder{2, 6, 10, 12, 4, 8}));
}

TEST(Layouts, orderNothingOfATreeOfOneLeaf) {
    for (const Layout& layout : layouts())
        EXPECT_TRUE(layout.function(test::treeOfPairs({}), {}).order.empty()) << layout.name;
}

// The deepest allowed tree must not overflow a stack: chains to the left, and chains to the right.
TEST(Layouts, followTheDeepestChains) {
    for (const uint32_t side : {0u, 1u}) {
        std::vector<std::pair<uint32_t, uint32_t>> pairs{{0, 2}};
        while (pairs.size() < kMaxDepth)
            pairs.emplace_back(pairs.back().second + side, pairs.back().second + 2);
        const Bvh chain = test::treeOfPairs(pairs);
        for (const Layout& layout : layouts()) {
            const NodeOrder order = layout.function(chain, {}).order;
            ASSERT_EQ(order.size(), kMaxDepth) << layout.name;
            EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << layout.name;
        }
    }
}

/// Returns how many blocks of `perBlock` pairs a line through the root's box enters on average, by areas: the
/// crossings from the block of a pair into another block.
double crossings(const Bvh& bvh, const NodeOrder& order, uint32_t perBlock) {
    const PairWeights weights = weightsByArea(bvh);
    std::vector<uint32_t> place(bvh.nodes.size() / 2, 0);
    for (uint32_t i = 0; i < order.size(); ++i) place[order[i] / 2] = i / perBlock;
    double sum = 1;
    for (size_t i = 2; i < bvh.nodes.size(); ++i) {
        const uint32_t below = bvh.nodes[i].left() / 2;
        if (!bvh.nodes[i].isLeaf() && place[below] != place[i / 2]) sum += weights[below];
    }
    return sum;
}

// The purpose of the orders: fewer lines and pages on the way down.
TEST(Layouts, crossFewerLinesAndPagesThanDepthFirst) {
    const Bvh bvh = buildBinned(test::sphereScene(80, 50), {.costs = {}, .maxLeafSize = 1});
    const auto ratio = [&](std::string_view layout, const LayoutOptions& options, uint32_t perBlock) {
        return crossings(bvh, orderOf(layout, bvh, options), perBlock) /
               crossings(bvh, orderOf("dfs", bvh), perBlock);
    };
    for (const uint32_t bytes : {8u, 16u}) {
        LayoutOptions options;
        options.recordBytes = bytes;
        SCOPED_TRACE(testing::Message() << bytes << " bytes");
        for (const std::string_view layout : {"odfs", "tdfs", "tbfs"})
            EXPECT_LE(ratio(layout, options, 64 / bytes), 0.99) << layout;
        EXPECT_LE(ratio("pack", options, 64 / bytes), 0.78);
    }
    LayoutOptions aabb;
    aabb.recordBytes = 64;
    for (const std::string_view layout : {"veb", "col", "pack"})
        EXPECT_LE(ratio(layout, aabb, 4096 / 64), 0.66) << layout;
}

// Pairs that no ray visited are ordered by area. Visits that were counted over no rays are ignored.
TEST(PairWeights, byVisitsAddLinesByArea) {
    Bvh bvh = test::treeOfPairs({{0, 2}, {3, 4}});
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    nodes[0].bounds = {{0, 0, 0}, {2, 2, 2}};
    bvh.nodes = std::move(nodes);
    const std::vector<uint32_t> visits{20, 10, 0};
    EXPECT_EQ(weightsByVisits(bvh, visits, 2), (PairWeights{60, 50, 10}));
    const PairWeights plain = weightsByVisits(bvh, visits, 0);
    EXPECT_NEAR(plain[1], 10, 1e-4);
    EXPECT_GT(plain[2], 0);
    EXPECT_LT(plain[2], 1e-4);
    EXPECT_EQ(weightsByVisits(bvh, std::vector<uint32_t>{0, 0, 0}, 2), weightsByArea(bvh));
}

TEST(PairWeights, byAreaAreThoseOfTheParentsBoxes) {
    Bvh bvh = test::treeOfPairs({{0, 2}, {3, 4}});
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    nodes[0].bounds = {{0, 0, 0}, {2, 2, 2}};
    nodes[3].bounds = {{0, 0, 0}, {1, 1, 1}};
    bvh.nodes = std::move(nodes);
    EXPECT_EQ(weightsByArea(bvh), (PairWeights{1, 1, 0.25}));
}

}  // namespace
}  // namespace bvhio
