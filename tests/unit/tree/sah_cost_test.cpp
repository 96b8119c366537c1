#include "tree/sah_cost.h"

#include <gtest/gtest.h>

namespace bvhio {
namespace {

// A root of half area 3 over two flat leaves, worked by hand.
TEST(SahCost, matchesHandWorkedTree) {
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 0}, {1, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 0}}, 0, 2};
    nodes[3] = {{{0, 0, 1}, {1, 1, 1}}, 2, 1};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1, 2}};
    EXPECT_DOUBLE_EQ(sahCost(bvh, {.traversal = 2, .intersection = 3}),
                     2 + 3 * (1.0 / 3) * 2 + 3 * (1.0 / 3) * 1);
}

TEST(SahCost, countsEveryAreaAsOneWhenTheRootHasNone) {
    AlignedVector<Node> nodes(2);
    nodes[0] = {{{1, 1, 1}, {1, 1, 1}}, 0, 2};
    nodes[1] = {};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1}};
    EXPECT_DOUBLE_EQ(sahCost(bvh, {.traversal = 1.2f, .intersection = 1}), 2);
}

}  // namespace
}  // namespace bvhio
