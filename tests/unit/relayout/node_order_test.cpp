#include "relayout/node_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "relayout/dfs.h"

namespace bvhio {
namespace {

Aabb unitBoxAt(float x) {
    return {{x, 0, 0}, {x + 1, 1, 1}};
}

// Three inner nodes and four leaves, in breadth-first order, with the leaves' primitives backwards:
// root(0) -> 2, 3; node 2 -> 4, 5; node 3 -> 6, 7.
Bvh breadthFirstTree() {
    AlignedVector<Node> nodes(8);
    nodes[0] = {{{0, 0, 0}, {4, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {2, 1, 1}}, 4, 0};
    nodes[3] = {{{2, 0, 0}, {4, 1, 1}}, 6, 0};
    nodes[4] = {unitBoxAt(0), 4, 1};
    nodes[5] = {unitBoxAt(1), 2, 2};
    nodes[6] = {unitBoxAt(2), 1, 1};
    nodes[7] = {unitBoxAt(3), 0, 1};
    return {std::move(nodes), std::vector<uint32_t>{13, 12, 11, 15, 10}};
}

std::vector<uint32_t> primitivesOf(const Bvh& bvh) {
    return {bvh.primitives.begin(), bvh.primitives.end()};
}

TEST(NodeOrder, movesPairsAndTheirParentsReferences) {
    const Bvh moved = applyNodeOrder(breadthFirstTree(), {2, 6, 4});  // the right subtree before the left one
    ASSERT_EQ(moved.nodes.size(), 8u);
    EXPECT_EQ(moved.nodes[0].left(), 2u);
    EXPECT_EQ(moved.nodes[2].left(), 6u);
    EXPECT_EQ(moved.nodes[3].left(), 4u);
    EXPECT_EQ(moved.nodes[4].bounds, unitBoxAt(2));
    EXPECT_EQ(moved.nodes[6].bounds, unitBoxAt(0));
    EXPECT_EQ(moved.nodes[1].first, 0u);
}

// For any order of nodes the primitives of a subtree must be one run, and their order within a leaf must stay
// the same.
TEST(NodeOrder, gathersPrimitivesDepthFirst) {
    for (const NodeOrder& order : {NodeOrder{2, 6, 4}, NodeOrder{2, 4, 6}}) {
        const Bvh moved = applyNodeOrder(breadthFirstTree(), order);
        EXPECT_EQ(primitivesOf(moved), (std::vector<uint32_t>{10, 11, 15, 12, 13}));
        const Node& leaf = moved.nodes[moved.nodes[moved.nodes[0].left()].right()];
        EXPECT_EQ(leaf.first, 1u);
        EXPECT_EQ(leaf.primitiveCount, 2u);
    }
}

TEST(NodeOrder, movesWhatIsKnownOfPairsAlike) {
    EXPECT_EQ(inNodeOrder(std::vector<uint32_t>{9, 1, 2, 3}, {2, 6, 4}), (std::vector<uint32_t>{9, 1, 3, 2}));
}

TEST(NodeOrder, keepsATreeOfOneLeaf) {
    AlignedVector<Node> nodes(2);
    nodes[0] = {unitBoxAt(0), 0, 2};
    nodes[1] = {};
    const Bvh moved = applyNodeOrder({std::move(nodes), std::vector<uint32_t>{1, 0}}, {});
    EXPECT_EQ(moved.nodes.size(), 2u);
    EXPECT_EQ(moved.nodes[0].primitiveCount, 2u);
    EXPECT_EQ(primitivesOf(moved), (std::vector<uint32_t>{1, 0}));
}

TEST(DepthFirst, doesNotDependOnTheOldOrder) {
    EXPECT_EQ(layoutDfs(breadthFirstTree(), {}).order, (NodeOrder{2, 4, 6}));
    const Bvh rightFirst = applyNodeOrder(breadthFirstTree(), {2, 6, 4});
    // Old indices: the left subtree is at 6.
    EXPECT_EQ(layoutDfs(rightFirst, {}).order, (NodeOrder{2, 6, 4}));
}

// The deepest allowed tree must not overflow the stacks: a chain of left children, and a chain of right
// children.
TEST(DepthFirst, followsTheDeepestChains) {
    for (const bool goesLeft : {true, false}) {
        AlignedVector<Node> nodes(2 * kMaxDepth + 2);
        nodes[1] = {};
        uint32_t inner = 0, primitive = 0;
        for (uint32_t left = 2; left < nodes.size(); left += 2) {
            nodes[inner] = {unitBoxAt(0), left, 0};
            inner = goesLeft ? left : left + 1;
            nodes[goesLeft ? left + 1 : left] = {unitBoxAt(0), primitive++, 1};
        }
        nodes[inner] = {unitBoxAt(0), primitive++, 1};
        std::vector<uint32_t> primitives(primitive);
        for (uint32_t i = 0; i < primitive; ++i) primitives[i] = i;
        const Bvh chain{std::move(nodes), std::move(primitives)};
        const Bvh moved = applyNodeOrder(chain, layoutDfs(chain, {}).order);
        std::vector<uint32_t> sorted = primitivesOf(moved);
        EXPECT_EQ(sorted.front(), goesLeft ? kMaxDepth : 0);  // to the left, the deepest leaf comes first
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(sorted, primitivesOf(chain));
    }
}

}  // namespace
}  // namespace bvhio
