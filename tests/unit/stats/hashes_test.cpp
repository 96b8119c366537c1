#include "stats/hashes.h"

#include <gtest/gtest.h>

#include <set>

#include "build/median.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"

namespace bvhio {
namespace {

using test::shuffledTree;

const Scene& scene() {
    static const Scene kScene = test::sceneOf(test::randomTriangles(300, 1, 0.2f));
    return kScene;
}
const Bvh& tree() {
    static const Bvh kTree = buildMedian(scene(), {.costs = {}, .maxLeafSize = 3});
    return kTree;
}
/// Returns the tree after `edit(nodes, primitives)`.
template <class Edit>
Bvh edited(const Edit& edit) {
    AlignedVector<Node> nodes(tree().nodes.begin(), tree().nodes.end());
    std::vector<uint32_t> primitives(tree().primitives.begin(), tree().primitives.end());
    edit(nodes, primitives);
    return {std::move(nodes), std::move(primitives)};
}
uint32_t firstLeaf(const AlignedVector<Node>& nodes, uint32_t from = 2) {
    while (!nodes[from].isLeaf()) ++from;
    return from;
}

TEST(Hashes, stayTheSameWhenALayoutMovesNodesSwapsChildrenAndReordersLeaves) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Bvh shuffled = shuffledTree(tree(), seed);
        EXPECT_EQ(topologyHash(shuffled), topologyHash(tree()));
        EXPECT_EQ(boundsHash(shuffled), boundsHash(tree()));
    }
}

TEST(Hashes, changeWhenTrianglesChangePlaces) {
    const Bvh swapped = edited([](auto& nodes, auto& primitives) {
        const uint32_t a = firstLeaf(nodes), b = firstLeaf(nodes, a + 1);
        std::swap(primitives[nodes[a].first], primitives[nodes[b].first]);
    });
    EXPECT_NE(topologyHash(swapped), topologyHash(tree()));
    EXPECT_NE(boundsHash(swapped), boundsHash(tree()));
}

TEST(Hashes, changeWhenSubtreesChangePlaces) {
    // Swap grandchildren of the root: every leaf stays the same, but the grouping changes.
    const Bvh swapped =
        edited([](auto& nodes, auto&) { std::swap(nodes[nodes[2].left()], nodes[nodes[3].left()]); });
    EXPECT_NE(topologyHash(swapped), topologyHash(tree()));
}

TEST(Hashes, tellALeafFromItsSplitAndFromAnotherTriangle) {
    const auto leafTree = [](std::vector<uint32_t> primitives) {
        const auto count = uint32_t(primitives.size());
        return Bvh{std::vector<Node>{{{{0, 0, 0}, {1, 1, 1}}, 0, count}, {}}, std::move(primitives)};
    };
    const Bvh split{std::vector<Node>{{{}, 2, 0}, {}, {{}, 0, 1}, {{}, 1, 1}}, std::vector<uint32_t>{0, 1}};
    const Bvh doubled{std::vector<Node>{{{}, 2, 0}, {}, {{}, 0, 1}, {{}, 1, 1}}, std::vector<uint32_t>{0, 0}};
    const std::set<uint64_t> hashes{
        topologyHash(leafTree({0})),    topologyHash(leafTree({1})), topologyHash(leafTree({0, 0})),
        topologyHash(leafTree({0, 1})), topologyHash(split),         topologyHash(doubled)};
    EXPECT_EQ(hashes.size(), 6u);
}

TEST(Hashes, seeABoxChangeInBoundsAlone) {
    const Bvh grown = edited([](auto& nodes, auto&) { nodes[firstLeaf(nodes)].bounds.max.x += 1e-6f; });
    EXPECT_EQ(topologyHash(grown), topologyHash(tree()));
    EXPECT_NE(boundsHash(grown), boundsHash(tree()));
}

TEST(Hashes, giveEqualSubtreesEqualHashes) {
    const std::vector<uint64_t> hashes = topologyHashes(tree());
    const std::vector<uint64_t> shuffled = topologyHashes(shuffledTree(tree(), 7));
    EXPECT_EQ(hashes.size(), tree().nodes.size());
    EXPECT_EQ(hashes[1], 0u);
    EXPECT_EQ(std::multiset(hashes.begin(), hashes.end()), std::multiset(shuffled.begin(), shuffled.end()));
}

TEST(Hashes, seeEveryPartOfAScene) {
    const auto make = [](float x, uint32_t index, std::string name, std::vector<uint32_t> sources) {
        return Scene{std::vector<Vec3>{{x, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     std::vector<TriangleIndices>{{0, 1, index}},
                     {{std::move(name), 0, 1}},
                     std::move(sources)};
    };
    const std::set<uint64_t> hashes{geometryHash(make(1, 2, "a", {})), geometryHash(make(2, 2, "a", {})),
                                    geometryHash(make(1, 1, "a", {})), geometryHash(make(1, 2, "b", {})),
                                    geometryHash(make(1, 2, "a", {0}))};
    EXPECT_EQ(hashes.size(), 5u);
    EXPECT_EQ(geometryHash(make(1, 2, "a", {})), geometryHash(make(1, 2, "a", {})));
}

// Files and tables of metrics quote hashes, so they must not depend on the compiler, the machine or the
// version.
TEST(Hashes, haveFixedValues) {
    const Scene two = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{5, 5, 5}, {6, 5, 5}, {5, 6, 7}}});
    const Bvh bvh = buildMedian(two, {.costs = {}, .maxLeafSize = 1});
    EXPECT_EQ(topologyHash(bvh), 14856552610325610803u);
    EXPECT_EQ(boundsHash(bvh), 7065032346710058404u);
    EXPECT_EQ(geometryHash(two), 10008234380398591978u);
}

}  // namespace
}  // namespace bvhio
