#include "stats/diff.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/median.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "core/report.h"

namespace bvhio {
namespace {

Scene makeScene() {
    return test::sceneOf(test::randomTriangles(200, 1, 0.2f));
}

struct Sample {
    Scene scene = makeScene();
    Bvh bvh = buildMedian(scene, {});
    EncodedBvh encoded = AabbForm(bvh);

    DiffSide side() const { return {scene, encoded}; }
    Sample with(Bvh other) const { return {scene, other, AabbForm(other)}; }
    template <class Edit>
    Sample edited(const Edit& edit) const {
        AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
        std::vector<uint32_t> primitives(bvh.primitives.begin(), bvh.primitives.end());
        edit(nodes, primitives);
        return with({std::move(nodes), std::move(primitives)});
    }
};

std::vector<Aspect> aspects(const std::vector<Difference>& differences) {
    std::vector<Aspect> result;
    for (const Difference& d : differences) result.push_back(d.aspect);
    return result;
}

TEST(Diff, findsNothingBetweenEqualFiles) {
    const Sample a, b;
    EXPECT_TRUE(differences(a.side(), b.side()).empty());
    const Report report = diffReport(a.side(), b.side());
    EXPECT_EQ(report["verdict"], "identical");
    EXPECT_EQ(report["shared_subtrees"], a.bvh.nodeCount());
    EXPECT_EQ(report["largest_shift"], 0);
    EXPECT_EQ(report["a"], report["b"]);
}

// Passes judge trees by the costs in the file, so other costs give other trees.
TEST(Diff, findsOtherCostsOfTheSameTree) {
    const Sample a;
    DiffSide b = a.side();
    b.costs.traversal = 2;
    const std::vector<Difference> found = differences(a.side(), b);
    ASSERT_EQ(aspects(found), std::vector{Aspect::costs});
    EXPECT_EQ(found[0].first, "traversal cost: 1.2 and 2");
    EXPECT_EQ(found[0].count, 1u);
}

TEST(Diff, callsARelayoutAnotherOrderAndNothingElse) {
    const Sample a;
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Sample b = a.with(test::shuffledTree(a.bvh, seed));
        EXPECT_EQ(aspects(differences(a.side(), b.side())), std::vector{Aspect::order});
        const Report report = diffReport(a.side(), b.side());
        EXPECT_EQ(report["verdict"], "order");
        EXPECT_EQ(report["shared_subtrees"], a.bvh.nodeCount());
        EXPECT_EQ(report["a"]["bounds_hash"], report["b"]["bounds_hash"]);
    }
}

TEST(Diff, seesTrianglesReorderedWithinALeaf) {
    const Sample a;
    const Sample b = a.edited([](auto&, auto& primitives) { std::swap(primitives[0], primitives[1]); });
    const std::vector<Difference> found = differences(a.side(), b.side());
    ASSERT_EQ(aspects(found), std::vector{Aspect::order});
    EXPECT_EQ(found[0].count, 2u);
    EXPECT_EQ(found[0].first, "leaf entry 0: " + std::to_string(a.bvh.primitives[0]) + " and " +
                                  std::to_string(a.bvh.primitives[1]));
}

TEST(Diff, findsAChangedBoxAlsoInAnotherOrder) {
    const Sample a;
    const auto last = uint32_t(a.bvh.nodes.size() - 1);
    const Sample b = a.edited([&](auto& nodes, auto&) { nodes[last].bounds.max.x = 7; });
    const std::vector<Difference> found = differences(a.side(), b.side());
    ASSERT_EQ(aspects(found), std::vector{Aspect::boxes});
    EXPECT_EQ(found[0].count, 1u);
    EXPECT_NE(found[0].first.find("node " + std::to_string(last)), std::string::npos) << found[0].first;
    EXPECT_NE(found[0].first.find("to (7, "), std::string::npos) << found[0].first;

    const Sample c = b.with(test::shuffledTree(b.bvh, 3));
    const std::vector<Difference> both = differences(a.side(), c.side());
    ASSERT_EQ(aspects(both), (std::vector{Aspect::order, Aspect::boxes}));
    EXPECT_EQ(both[1].count, 1u);
}

TEST(Diff, findsWhereTheTopologyDiffersThroughSwappedChildren) {
    const Sample a;
    // The leaves of the last pair swap a triangle: all subtrees except theirs and their ancestors' stay the
    // same.
    const auto last = uint32_t(a.bvh.nodes.size() - 1);
    ASSERT_TRUE(a.bvh.nodes[last].isLeaf() && a.bvh.nodes[last - 1].isLeaf());
    const Sample b = a.edited([&](auto& nodes, auto& primitives) {
        std::swap(primitives[nodes[last].first], primitives[nodes[last - 1].first]);
    });
    for (const Sample& other : {b, b.with(test::shuffledTree(b.bvh, 11))}) {
        const std::vector<Difference> found = differences(a.side(), other.side());
        ASSERT_EQ(aspects(found), std::vector{Aspect::topology});
        uint32_t parent = last, depth = 0;
        for (uint32_t child = last; child > 1; child = parent, ++depth)
            for (parent = 0; a.bvh.nodes[parent].isLeaf() || a.bvh.nodes[parent].first != (child & ~1u);)
                ++parent;
        EXPECT_EQ(found[0].count, depth + 2) << "two leaves and their ancestors";
        EXPECT_NE(found[0].first.find("at depth " + std::to_string(depth - 1)), std::string::npos)
            << found[0].first;
        EXPECT_EQ(diffReport(a.side(), other.side())["shared_subtrees"], a.bvh.nodeCount() - depth - 2);
    }
}

TEST(Diff, comparesALeafWithATree) {
    const Sample a;
    Sample leaf;
    leaf = leaf.with(buildMedian(leaf.scene, {.costs = {}, .maxLeafSize = 1000}));
    const std::vector<Difference> found = differences(a.side(), leaf.side());
    ASSERT_EQ(aspects(found), std::vector{Aspect::topology});
    EXPECT_EQ(found[0].first, "node 0 and node 0 (a leaf of 200) at depth 0 group triangles differently");
}

TEST(Diff, findsAMovedVertexAndHowFarItMoved) {
    const Sample a;
    Sample b;
    std::vector<Vec3> vertices(b.scene.vertices.begin(), b.scene.vertices.end());
    vertices[12] = vertices[12] + Vec3{3, 0, 4};
    b.scene.vertices = std::move(vertices);
    const std::vector<Difference> found = differences(a.side(), b.side());
    ASSERT_EQ(aspects(found), std::vector{Aspect::geometry});
    EXPECT_EQ(found[0].count, 1u);
    EXPECT_EQ(found[0].first.find("vertex 12: ("), 0u);
    EXPECT_NEAR(diffReport(a.side(), b.side())["largest_shift"].get<double>(), 5, 1e-6);
}

TEST(Diff, comparesScenesOfDifferentSizes) {
    const Sample a;
    Sample b;
    b.scene = test::sceneOf(test::randomTriangles(201, 1, 0.2f));
    b = b.with(buildMedian(b.scene, {}));
    const std::vector<Difference> found = differences(a.side(), b.side());
    EXPECT_EQ(aspects(found), (std::vector{Aspect::topology, Aspect::geometry}));
    EXPECT_EQ(found[1].first, "600 and 603 vertices");
    const Report report = diffReport(a.side(), b.side());
    EXPECT_EQ(report["verdict"], "geometry");
    EXPECT_TRUE(report["largest_shift"].is_null());
}

TEST(Diff, seesRenamedGeometriesAndSourceNumbers) {
    const Sample a;
    Sample b, c;
    b.scene.geometries[0].name = "renamed";
    c.scene.sourcePrimitives = std::vector<uint32_t>(200, 5);
    EXPECT_EQ(differences(a.side(), b.side()).at(0).first,
              "geometry 0: 'test' of 200 triangles from 0 and 'renamed' of 200 triangles from 0");
    EXPECT_EQ(differences(a.side(), c.side()).at(0).first, "0 and 200 source numbers");
}

}  // namespace
}  // namespace bvhio
