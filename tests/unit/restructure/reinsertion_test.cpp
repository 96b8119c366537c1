#include "restructure/reinsertion.h"

#include <gtest/gtest.h>

#include <chrono>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "restructure/reinsertion_search.h"
#include "restructure/reinsertion_treelet.h"

namespace bvhio {
namespace {

/// Returns a tree of one triangle per leaf with primitives in random order, so that many subtrees are
/// misplaced.
Bvh badTree(const Scene& scene, uint64_t seed) {
    Random random(seed);
    AlignedVector<Node> nodes(2 * scene.triangles.size());
    std::vector<uint32_t> primitives(scene.triangles.size());
    for (uint32_t i = 0; i < primitives.size(); ++i) {
        primitives[i] = i;
        std::swap(primitives[i], primitives[random.below(i + 1)]);
    }
    nodes[0] = nodes[1] = Node{};
    uint32_t next = 2;
    const auto build = [&](const auto& self, uint32_t slot, uint32_t first, uint32_t count) -> void {
        if (count == 1) {
            nodes[slot] = {bounds(scene.triangle(primitives[first])), first, 1};
            return;
        }
        const uint32_t pair = next, left = 1 + random.below(count - 1);
        next += 2;
        self(self, pair, first, left);
        self(self, pair + 1, first + left, count - left);
        nodes[slot] = {unite(nodes[pair].bounds, nodes[pair + 1].bounds), pair, 0};
    };
    build(build, 0, 0, uint32_t(primitives.size()));
    return {std::move(nodes), std::move(primitives)};
}

/// Computes the sum of the inner nodes' areas below a node, with `moved` next to `beside` instead of at its
/// place.
class Moved {
  public:
    Moved(const TreeEditor& tree, uint32_t moved, uint32_t beside)
        : tree_(tree), moved_(moved), beside_(beside) {}

    double areas() {
        visit(0);
        return sum_;
    }

  private:
    Aabb visit(uint32_t slot) {
        const Node& node = tree_[slot];
        Aabb box = node.bounds;
        if (!node.isLeaf()) {
            if (node.left() == (moved_ & ~1u) && beside_ != 0) {
                box = visit(tree_.sibling(moved_));
            } else {
                box = visit(node.left());
                box.extend(visit(node.right()));
                sum_ += halfArea(box);
            }
        }
        if (slot == beside_ && beside_ != 0) {
            const uint32_t beside = std::exchange(beside_, 0);
            box.extend(visit(moved_));
            beside_ = beside;
            sum_ += halfArea(box);
        }
        return box;
    }

    const TreeEditor& tree_;
    const uint32_t moved_;
    uint32_t beside_;  // 0: nothing has moved
    double sum_ = 0;
};

bool isBelow(const TreeEditor& tree, uint32_t slot, uint32_t top) {
    for (; slot != top; slot = tree.parent(slot))
        if (slot == 0) return false;
    return true;
}

// A search that prunes too much, or counts a node on the way twice, misses the best place. A search whose
// areas overflow misses all places.
TEST(Reinsertion, findsTheBestPlaceOfAll) {
    uint32_t found = 0;
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        std::vector<Triangle> triangles = test::randomTriangles(14, 1, seed % 2 == 0 ? 0.1f : 0.7f, seed);
        // In every other scene the extent is beyond the range of floats.
        for (Triangle& t : triangles)
            for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * (seed % 4 < 2 ? 0x1p127f : 1.0f);
        const Scene scene = test::sceneOf(triangles);
        const Bvh bvh = badTree(scene, seed);
        const TreeEditor tree(scene, bvh, {});
        const float scale = extentScale(tree[0].bounds);
        const double areas = Moved(tree, 0, 0).areas(), rootArea = halfArea(tree[0].bounds);
        for (uint32_t moved = 2; moved < tree.size(); ++moved) {
            Place place;
            findPlaces(tree, scale, {&moved, 1}, &place);
            double best = 0;
            for (uint32_t beside = 2; beside < tree.size(); ++beside) {
                if (isBelow(tree, beside, moved) || beside == tree.sibling(moved) ||
                    isBelow(tree, moved, beside))
                    continue;
                best = std::max(best, areas - Moved(tree, moved, beside).areas());
            }
            ASSERT_NEAR(place.gain, best * scale * scale, 1e-5 * rootArea * scale * scale)
                << seed << " " << moved;
            if (place.gain == 0) continue;
            ++found;
            EXPECT_NEAR(areas - Moved(tree, moved, place.beside).areas(), best, 1e-5 * rootArea);
        }
    }
    EXPECT_GT(found, 300u);
}

// Six triangles in two distant clusters; one triangle of the second cluster is among those of the first.
TEST(Reinsertion, movesAMisplacedTriangleHome) {
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 1.0f, 2.0f, 100.0f, 101.0f, 102.0f})
        triangles.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 1}});
    const Scene scene = test::sceneOf(triangles);
    AlignedVector<Node> nodes(12);
    const auto inner = [&](uint32_t slot, uint32_t pair) {
        nodes[slot] = {unite(nodes[pair].bounds, nodes[pair + 1].bounds), pair, 0};
    };
    const auto leaf = [&](uint32_t slot, uint32_t triangle) {
        nodes[slot] = {bounds(triangles[triangle]), triangle, 1};
    };
    leaf(10, 1), leaf(11, 4), leaf(8, 2), inner(9, 10), leaf(6, 3), leaf(7, 5), leaf(4, 0), inner(5, 8);
    inner(2, 4), inner(3, 6), inner(0, 2);
    nodes[1] = Node{};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1, 2, 3, 4, 5}};
    RestructureOptions options;
    options.collapse = false;
    const Restructured result = restructureReinsertion(scene, bvh, options);
    test::expectValid(scene, result.bvh, 1);
    ASSERT_FALSE(result.iterations.empty());
    EXPECT_GE(result.iterations[0].changes, 1u);
    const Aabb &a = result.bvh.nodes[2].bounds, &b = result.bvh.nodes[3].bounds;
    EXPECT_EQ(std::min(a.max.x, b.max.x), 3);
    EXPECT_EQ(std::max(a.min.x, b.min.x), 100);
}

// A method that judged moves by areas alone would break up leaves that it could not form again.
TEST(Reinsertion, lowersTheCostWithEachIteration) {
    const Scene scenes[] = {test::sceneOf(test::randomTriangles(3000, 1, 0.2f)),
                            test::sceneOf(test::randomTriangles(3000, 1, 0.02f)), test::sphereScene(60, 30),
                            test::gridScene(40, [](float x, float y) { return float(int(x * y) % 7); })};
    for (const Scene& scene : scenes)
        for (const SahCosts costs : {SahCosts{}, SahCosts{1, 1}, SahCosts{20, 1}, SahCosts{1, 20}})
            for (const uint32_t leafSize : {1u, 32u})
                for (const bool collapse : {true, false}) {
                    const Bvh before =
                        builders()[0].function(scene, {.costs = costs, .maxLeafSize = leafSize});
                    RestructureOptions options;
                    options.costs = costs;
                    options.collapse = collapse;
                    options.recordCosts = true;
                    options.iterations = 40;
                    const Restructured result = restructureReinsertion(scene, before, options);
                    double cost = sahCost(before, costs);
                    for (const RestructureIteration& iteration : result.iterations) {
                        ASSERT_LE(iteration.sahCost, cost * (1 + 1e-12));
                        cost = iteration.sahCost;
                    }
                    EXPECT_LE(sahCost(result.bvh, costs), cost * (1 + 1e-12));
                }
}

TEST(Reinsertion, costsNoMoreWithMoreIterations) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.05f));
    const Bvh before = builders()[0].function(scene, {});
    double last = sahCost(before, {}), first = 0;
    for (const uint32_t iterations : {1u, 2u, 5u, 10u, 30u, 100u}) {
        RestructureOptions options;
        options.iterations = iterations;
        const double cost = sahCost(restructureReinsertion(scene, before, options).bvh, {});
        EXPECT_LE(cost, last);
        if (iterations == 1) first = cost;
        last = cost;
    }
    EXPECT_LT(last, 0.97 * first);
}

TEST(Reinsertion, stopsWhenNothingGains) {
    const Scene scene = test::sphereScene(20, 10);
    RestructureOptions options;
    options.iterations = 100000;
    Progress progress;
    options.progress = &progress;
    const Restructured once = restructureReinsertion(scene, builders()[0].function(scene, {}), options);
    EXPECT_LT(once.iterations.size(), 1000u);
    EXPECT_EQ(once.iterations.back().changes, 0u);
    EXPECT_EQ(progress.done.load(), progress.total.load());
}

// Steps that fail must leave no traces. Steps that succeed must lower the cost of the tree.
TEST(Reinsertion, recreatesTreelets) {
    const Scene scene = test::sceneOf(test::randomTriangles(2000, 1, 0.1f));
    const Bvh before = badTree(scene, 5);
    for (const uint32_t leaves : {1u, 2u, 3u, 50u, 5000u})
        for (const uint32_t steps : {0u, 1u, 500u}) {
            RestructureOptions options;
            options.collapse = leaves != 50;
            TreeEditor tree(scene, before, options);
            std::vector<uint8_t> touched(tree.size());
            SubtreeMoves moves(tree, touched.data());
            ReinsertionTreelet treelet(moves, 0, leaves);
            Random random(1);
            const uint32_t better = treelet.improve(steps, random);
            treelet.write(moves);
            tree.endIteration(better);
            for (const uint32_t slot : treelet.openLeaves(moves)) ASSERT_FALSE(tree[slot].isLeaf());
            const Bvh after = std::move(tree).finish(0).bvh;
            test::expectValid(scene, after, kMaxLeafSize);
            TreeEditor unchanged(scene, before, options);
            const double unchangedCost = sahCost(std::move(unchanged).finish(0).bvh, {});
            if (better == 0)
                EXPECT_NEAR(sahCost(after, {}), unchangedCost, 1e-12 * unchangedCost);
            else
                EXPECT_LT(sahCost(after, {}), unchangedCost);
            EXPECT_TRUE(better == 0 || (leaves >= 3 && steps > 0));
            EXPECT_TRUE(better > 0 || leaves < 50 || steps < 500);
        }
}

/// Returns triangles that all overlap each other.
Scene pileOf(uint32_t count) {
    return test::sceneOf(test::randomTriangles(count, 0.001f, 1));
}

// If all places are equally good, or nearly, a search without limits looks at all of them.
TEST(Reinsertion, takesBoundedTimeOnPilesOfTriangles) {
    for (const Scene& scene : {test::coincidentScene(1000000), pileOf(100000)}) {
        const Bvh before = builders()[0].function(scene, {});
        const auto start = std::chrono::steady_clock::now();
        restructureReinsertion(scene, before, {});
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    }
}

// Nested boxes: the best tree is a chain, which is deeper than allowed.
TEST(Reinsertion, keepsTheBoundOnDepth) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 3000; ++i) {
        const float r = std::pow(1.01f, float(i));
        triangles.push_back({{-r, -r, -r}, {r, -r, r}, {r, r, r}});
    }
    const Scene scene = test::sceneOf(triangles);
    const Bvh before = badTree(scene, 3);
    RestructureOptions options;
    options.iterations = 200;
    test::expectValid(scene, restructureReinsertion(scene, before, options).bvh, kMaxLeafSize);
}

}  // namespace
}  // namespace bvhio
