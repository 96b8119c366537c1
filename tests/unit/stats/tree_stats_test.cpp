#include "stats/tree_stats.h"

#include <gtest/gtest.h>

#include "build/median.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "core/report.h"
#include "relayout/clusters.h"
#include "relayout/layouts.h"

namespace bvhio {
namespace {

// The unit cube over its bottom half and an inner node over two leaves in the top half, which share a slab of
// 1/4.
Bvh handWorkedTree() {
    AlignedVector<Node> nodes(6);
    nodes[0] = {{{0, 0, 0}, {1, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 0.5f}}, 0, 3};
    nodes[3] = {{{0, 0, 0.5f}, {1, 1, 1}}, 4, 0};
    nodes[4] = {{{0, 0, 0.5f}, {0.625f, 1, 1}}, 3, 1};
    nodes[5] = {{{0.375f, 0, 0.5f}, {1, 1, 1}}, 4, 3};
    return {std::move(nodes), std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6}};
}

TEST(TreeStats, matchesAHandWorkedTree) {
    const TreeStats stats = treeStats(handWorkedTree(), {.traversal = 2, .intersection = 3});
    EXPECT_EQ(stats.references, 7u);
    EXPECT_EQ(stats.nodes, 5u);
    EXPECT_EQ(stats.innerNodes, 2u);
    EXPECT_EQ(stats.leaves, 3u);
    EXPECT_EQ(stats.maxDepth, 2u);
    EXPECT_DOUBLE_EQ(stats.averageLeafDepth, 5.0 / 3);
    // Half areas: root 3, halves 2, each leaf .625 + .5 + .3125 = 1.4375, their shared slab .25 + .5 + .125 =
    // .875.
    EXPECT_DOUBLE_EQ(stats.expectedInnerNodes, 5.0 / 3);
    EXPECT_DOUBLE_EQ(stats.expectedLeaves, (2 + 2 * 1.4375) / 3);
    EXPECT_DOUBLE_EQ(stats.expectedTriangles, (3 * 2 + 4 * 1.4375) / 3);
    EXPECT_DOUBLE_EQ(stats.sahCost, 2 * stats.expectedInnerNodes + 3 * stats.expectedTriangles);
    EXPECT_DOUBLE_EQ(stats.childOverlap, 0.875 / 5) << "the two halves only touch";
    EXPECT_EQ(stats.leafDepths, (std::vector<uint64_t>{0, 1, 2}));
    EXPECT_EQ(stats.leafSizes, (std::vector<uint64_t>{0, 1, 0, 2}));
}

TEST(TreeStats, countsTheOverlapOfBoxesThatAreFlatInOnePlane) {
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 1}, {3, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 1}, {2, 1, 1}}, 0, 1};
    nodes[3] = {{{1, 0, 1}, {3, 1, 1}}, 1, 1};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1}};
    EXPECT_DOUBLE_EQ(treeStats(bvh, {}).childOverlap, 1.0 / 3);
}

TEST(TreeStats, ofASingleLeafAndOfAPoint) {
    const Scene scene = test::sceneOf(std::vector<Triangle>(3, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
    const TreeStats leaf = treeStats(buildMedian(scene, {}), {});
    EXPECT_EQ(leaf.nodes, 1u);
    EXPECT_EQ(leaf.maxDepth, 0u);
    EXPECT_EQ(leaf.averageLeafDepth, 0);
    EXPECT_EQ(leaf.leafSizes, (std::vector<uint64_t>{0, 0, 0, 1}));
    const TreeStats point = treeStats(buildMedian(scene, {.costs = {}, .maxLeafSize = 1}), {});
    EXPECT_EQ(point.expectedLeaves, 3) << "without area every ratio counts as 1";
    EXPECT_EQ(point.childOverlap, 0);
}

TEST(TreeStats, fillsTheReport) {
    Report report;
    addTo(report, treeStats(handWorkedTree(), {.traversal = 2, .intersection = 3}));
    EXPECT_EQ(report["nodes"], 5);
    EXPECT_EQ(report["leaves"], 3);
    EXPECT_EQ(report["traversal_cost"], 2);
    EXPECT_EQ(report["leaf_sizes"].dump(), R"({"1":1,"3":2})");
    EXPECT_EQ(report["leaf_depths"].dump(), R"({"1":1,"2":2})");
}

/// Returns the tree in the order of a layout, as bvh-relayout writes it.
Bvh laidOut(const Bvh& bvh, std::string_view layout, const LayoutOptions& options = {}) {
    return applyLayout(bvh, choose(layouts(), "layout", layout).function(bvh, options));
}

// A report that says "other" for an order that can be recognised, or gives it the name of another one,
// misleads.
TEST(LayoutName, tellsWhatCanBeSeen) {
    const Scene scene = test::sceneOf(test::randomTriangles(64, 1, 0.2f));
    const Bvh tree = buildMedian(scene, {.costs = {}, .maxLeafSize = 1});
    EXPECT_EQ(layoutName(tree), "dfs");
    EXPECT_EQ(layoutName(test::shuffledTree(tree, 1, false)), "other");
    for (const auto& [layout, name] : {std::pair{"dfs", "dfs"},
                                       {"odfs", "odfs"},
                                       {"bfs", "bfs"},
                                       {"veb", "other"},
                                       {"clusters", "clusters"}})
        EXPECT_EQ(layoutName(laidOut(tree, layout)), name);

    // Weights by visits, which go to the right.
    LayoutOptions options;
    options.weights.assign(tree.nodes.size() / 2, 1);
    for (size_t i = 2; i < tree.nodes.size(); ++i)
        if (!tree.nodes[i].isLeaf())
            options.weights[tree.nodes[i].left() / 2] = options.weights[i / 2] * (i % 2 == 0 ? 0.5 : 0.9);
    EXPECT_EQ(layoutName(laidOut(tree, "odfs", options)), "depth-first");

    EXPECT_EQ(layoutName(buildMedian(test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), {})), "dfs");
}

}  // namespace
}  // namespace bvhio
