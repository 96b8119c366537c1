#include "restructure/tree_editor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/test_scenes.h"

namespace bvhio {
namespace {

Bvh builtWithLeavesOf(const Scene& scene, uint32_t maxLeafSize) {
    return builders()[0].function(scene, {.costs = {1000, 1}, .maxLeafSize = maxLeafSize});
}

TEST(TreeEditor, opensLeavesToOneReferenceEach) {
    for (const uint32_t maxLeafSize : {1u, 4u, 100u, kMaxLeafSize}) {
        const Scene scene = test::sceneOf(test::randomTriangles(70000, 1, 0.01f));
        const Bvh bvh = builtWithLeavesOf(scene, maxLeafSize);
        const TreeEditor editor(scene, bvh, {});
        ASSERT_EQ(editor.size(), 2 * scene.triangles.size());
        EXPECT_EQ(editor[0].bounds, bvh.nodes[0].bounds);
        std::vector<bool> seen(scene.triangles.size());
        for (uint32_t i = 0; i < editor.size(); ++i) {
            if (i == 1) continue;
            const Node& node = editor[i];
            EXPECT_TRUE(i == 0 || editor[editor.parent(i)].left() == (i & ~1u));
            if (node.isLeaf()) {
                ASSERT_EQ(node.primitiveCount, 1u);
                EXPECT_TRUE(node.bounds.contains(bounds(scene.triangle(bvh.primitives[node.first]))));
                seen[bvh.primitives[node.first]] = true;
            } else {
                ASSERT_GT(node.left(), i);
                EXPECT_TRUE(node.bounds.contains(editor[node.left()].bounds));
                EXPECT_TRUE(node.bounds.contains(editor[node.right()].bounds));
            }
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), true), ptrdiff_t(seen.size()));
    }
}

TEST(TreeEditor, keepsLeavesWholeWithoutCollapse) {
    const Scene scene = test::sphereScene(40, 20);
    const Bvh bvh = builtWithLeavesOf(scene, 8);
    RestructureOptions options;
    options.collapse = false;
    TreeEditor editor(scene, bvh, options);
    EXPECT_EQ(editor.size(), bvh.nodes.size());
    EXPECT_TRUE(test::sameBytes(std::move(editor).finish(0).bvh, bvh));
}

// A part of a split triangle keeps the box that it has in its leaf, so opening leaves must not enlarge boxes.
TEST(TreeEditor, opensSplitTrianglesWithinTheirLeaves) {
    const Scene scene = test::sceneOf({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}});
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 0}, {4, 4, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {2, 4, 1}}, 0, 2};
    nodes[3] = {{{2, 0, 0}, {4, 2, 0}}, 2, 1};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1, 0}};
    const TreeEditor editor(scene, bvh, {});
    ASSERT_EQ(editor.size(), 6u);
    EXPECT_EQ(editor[2].left(), 4u);
    for (const uint32_t i : {4u, 5u}) EXPECT_TRUE(editor[2].bounds.contains(editor[i].bounds));
}

// If a method makes the tree worse, the given tree is returned.
TEST(TreeEditor, fallsBackOnTheGivenTree) {
    const Scene scene = test::sceneOf(test::randomTriangles(1000, 1, 0.01f));
    const Bvh bvh = builders()[0].function(scene, {});
    TreeEditor editor(scene, bvh, {});
    for (uint32_t i = 2; i < editor.size(); ++i) editor[i].bounds = editor[0].bounds;
    EXPECT_TRUE(test::sameBytes(std::move(editor).finish(0).bvh, bvh));
}

}  // namespace
}  // namespace bvhio
