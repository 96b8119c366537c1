// Layouts over trees small enough to write their orders out.
#include "relayout/layouts.h"

#include <gtest/gtest.h>

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
// The right side is likelier everywhere but below 6.
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

TEST(Layouts, orderNothingOfATreeOfOneLeaf) {
    for (const Layout& layout : layouts())
        EXPECT_TRUE(layout.function(test::treeOfPairs({}), {}).order.empty()) << layout.name;
}

// The deepest tree allowed must not overflow a stack: chains that go on to the left, and to the right.
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
