#include "stats/epo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "build/median.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "stats/convex_polygon.h"

namespace bvhio {
namespace {

using test::randomTriangles;
using test::sceneOf;

constexpr SahCosts kCosts{.traversal = 2, .intersection = 3};

Bvh treeOf(std::vector<Node> nodes, std::vector<uint32_t> primitives) {
    nodes.insert(nodes.begin() + 1, Node{});
    return {std::move(nodes), std::move(primitives)};
}

/// Computes the area of a triangle inside a box in another way: barycentric coordinates are cut, not points,
/// and the corners of the result are found by trying every pair of constraints and keeping the feasible
/// crossings.
double areaWithin(const Triangle& t, const Aabb& box) {
    struct Line {  // a * u + b * v <= c
        double a, b, c;
    };
    std::vector<Line> lines{{-1, 0, 0}, {0, -1, 0}, {1, 1, 1}};
    for (int axis = 0; axis < 3; ++axis) {
        const double o = t.v0[axis], a = t.v1[axis] - o, b = t.v2[axis] - o;
        lines.push_back({a, b, box.max[axis] - o});
        lines.push_back({-a, -b, o - box.min[axis]});
    }
    std::vector<std::pair<double, double>> corners;
    for (size_t i = 0; i < lines.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
            const Line &p = lines[i], &q = lines[j];
            const double det = p.a * q.b - p.b * q.a;
            if (std::abs(det) < 1e-12) continue;
            const double u = (p.c * q.b - p.b * q.c) / det, v = (p.a * q.c - p.c * q.a) / det;
            bool isFeasible = true;
            for (const Line& l : lines) isFeasible &= l.a * u + l.b * v <= l.c + 1e-9;
            if (isFeasible) corners.push_back({u, v});
        }
    // The hull of the corners, which are sorted by angle around their mean.
    if (corners.size() < 3) return 0;
    double mu = 0, mv = 0;
    for (const auto& [u, v] : corners) mu += u / double(corners.size()), mv += v / double(corners.size());
    std::sort(corners.begin(), corners.end(), [&](const auto& p, const auto& q) {
        return std::atan2(p.second - mv, p.first - mu) < std::atan2(q.second - mv, q.first - mu);
    });
    double doubled = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const auto& [pu, pv] = corners[i];
        const auto& [qu, qv] = corners[(i + 1) % corners.size()];
        doubled += (pu - mu) * (qv - mv) - (pv - mv) * (qu - mu);
    }
    return area(t) * doubled;  // the unit triangle of (u, v) has area 1/2
}

/// Computes the EPO by its definition: every triangle against every node.
double bruteForceEpo(const Scene& scene, const Bvh& bvh, const SahCosts& costs) {
    std::vector<std::set<uint32_t>> below(bvh.nodes.size());
    double sum = 0, total = 0;
    for (size_t t = 0; t < scene.triangles.size(); ++t) total += area(scene.triangle(t));
    for (size_t n = bvh.nodes.size(); n-- > 0;) {
        if (n == 1) continue;
        const Node& node = bvh.nodes[n];
        if (node.isLeaf()) {
            const auto* first = bvh.primitives.data() + node.first;
            below[n].insert(first, first + node.primitiveCount);
        } else {
            below[n] = below[node.left()];
            below[n].insert(below[node.right()].begin(), below[node.right()].end());
        }
        const double cost = node.isLeaf() ? costs.intersection * node.primitiveCount : costs.traversal;
        for (uint32_t t = 0; t < scene.triangles.size(); ++t)
            if (!below[n].contains(t)) sum += cost * areaWithin(scene.triangle(t), node.bounds);
    }
    return sum / total;
}

TEST(ConvexPolygon, findsTheAreaOfATriangleInABox) {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const ConvexPolygon whole(triangle);
    EXPECT_DOUBLE_EQ(whole.area(), 8);
    EXPECT_DOUBLE_EQ(whole.clippedTo({{0, 0, -1}, {1, 1, 1}}).area(), 1);
    EXPECT_DOUBLE_EQ(whole.clippedTo({{1, 1, -1}, {9, 9, 1}}).area(), 2);
    EXPECT_DOUBLE_EQ(whole.clippedTo({{1, 1, -1}, {2, 9, 1}}).area(), 1.5);
    EXPECT_TRUE(whole.clippedTo({{3, 3, -1}, {9, 9, 1}}).isEmpty());
    EXPECT_EQ(whole.placeIn({{0, 0, 0}, {4, 4, 0}}), ConvexPolygon::Place::inside);
    EXPECT_EQ(whole.placeIn({{4.5f, 0, 0}, {5, 4, 0}}), ConvexPolygon::Place::outside);
}

TEST(ConvexPolygon, countsWhatLiesInAFlatBoxOrAFace) {
    const ConvexPolygon flat({{0, 0, 1}, {4, 0, 1}, {0, 4, 1}});
    EXPECT_DOUBLE_EQ(flat.clippedTo({{0, 0, 1}, {1, 1, 1}}).area(), 1)
        << "a flat box in the triangle's plane";
    EXPECT_DOUBLE_EQ(flat.clippedTo({{0, 0, 1}, {1, 1, 2}}).area(), 1) << "in the bottom face";
    EXPECT_DOUBLE_EQ(flat.clippedTo({{0, 0, 0}, {1, 1, 1}}).area(), 1) << "in the top face";
    const ConvexPolygon slanted({{0, 0, 0}, {4, 0, 3}, {0, 4, 1}});
    EXPECT_NEAR(slanted.clippedTo({{0, 0, 1}, {4, 4, 1}}).area(), 0, 1e-15) << "a line";
    EXPECT_EQ(slanted.clippedTo({{0, 0, 0}, {0, 0, 0}}).area(), 0) << "a corner";
    EXPECT_EQ(flat.clippedTo({{-1, 0, 0}, {0, 4, 2}}).area(), 0) << "an edge";
}

TEST(ConvexPolygon, agreesWithACutOfBarycentricCoordinates) {
    Random random(3);
    for (const Triangle& t : randomTriangles(3000, 0.5f, 1)) {
        const auto coordinate = [&] { return float(int(random.below(9)) - 4) * 0.25f; };
        Aabb box = Aabb::empty();
        for (int i = 0; i < 2; ++i) {
            const float x = coordinate(), y = coordinate();
            box.extend(Vec3{x, y, coordinate()});
        }
        const ConvexPolygon whole(t), part = whole.clippedTo(box);
        const double expected = areaWithin(t, box);
        EXPECT_NEAR(part.area(), expected, 1e-7);
        if (whole.placeIn(box) == ConvexPolygon::Place::outside) {
            EXPECT_NEAR(expected, 0, 1e-7);
        }
    }
}

// Two unit right triangles side by side in one plane. The left leaf's box covers half of the right triangle's
// legs.
TEST(Epo, matchesAHandWorkedTree) {
    const Scene scene = sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}});
    const Bvh bvh = treeOf(
        {{{{0, 0, 0}, {2, 1, 0}}, 2, 0}, {{{0, 0, 0}, {1.5f, 1, 0}}, 0, 1}, {{{1, 0, 0}, {2, 1, 0}}, 1, 1}},
        {0, 1});
    // Of the right triangle's area of 1/2, 3/8 is left of x = 1.5. Only a point of the left triangle is in
    // the right box.
    const Epo found = epo(scene, bvh, kCosts);
    EXPECT_DOUBLE_EQ(found.value, 3 * 0.375 / 1.0);
    EXPECT_EQ(found.sampledTriangles, 2u);
    EXPECT_TRUE(found.isExact);
    EXPECT_EQ(found.standardError, 0);
}

TEST(Epo, weighsInnerNodesByTraversalAndLeavesByTheirReferences) {
    // Triangle 0 fills the box of the inner node over the leaves {1, 2} and {3}, all in its plane.
    const Triangle large{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, small{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Scene scene = sceneOf({large, small, small, small});
    const Aabb smallBox = bounds(small);
    const Bvh bvh = treeOf(
        {{bounds(large), 2, 0}, {bounds(large), 0, 1}, {smallBox, 4, 0}, {smallBox, 1, 2}, {smallBox, 3, 1}},
        {0, 1, 2, 3});
    // In leaf {0}: three triangles of 1/2. In the inner node: 1 of the large. In leaf {1, 2}: the large and
    // one small; in leaf {3}: the large and two small.
    const double expected = 3 * 1.5 + 2 * 1.0 + 3 * 2 * (1 + 0.5) + 3 * 1 * (1 + 2 * 0.5);
    EXPECT_DOUBLE_EQ(epo(scene, bvh, kCosts).value, expected / (8 + 1.5));
}

TEST(Epo, leavesOutATriangleBelowAnyOfItsReferences) {
    // One triangle in both leaves, as after a spatial split: no box contains parts of other triangles.
    const Scene scene = sceneOf({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}});
    const Bvh bvh = treeOf(
        {{{{0, 0, 0}, {2, 2, 0}}, 2, 0}, {{{0, 0, 0}, {1, 2, 0}}, 0, 1}, {{{1, 0, 0}, {2, 1, 0}}, 1, 1}},
        {0, 0});
    EXPECT_EQ(epo(scene, bvh, kCosts).value, 0);
}

TEST(Epo, countsReferencesOfADuplicatedTriangleOnlyWhereItIs) {
    // Triangle 0 is in the first two leaves, triangle 1 in the last, whose box triangle 0 also crosses.
    const Scene scene = sceneOf({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                                 {{2, 0, 0}, {4, 0, 0}, {2, 2, 0}},
                                 {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}}});
    const Bvh bvh = treeOf({{{{0, 0, 0}, {10, 10, 9}}, 2, 0},
                            {{{0, 0, 0}, {4, 4, 0}}, 4, 0},
                            {{{2, 0, 0}, {10, 10, 9}}, 6, 0},
                            {{{0, 0, 0}, {2, 4, 0}}, 0, 1},
                            {{{2, 0, 0}, {4, 2, 0}}, 1, 1},
                            {{{2, 0, 0}, {4, 2, 0}}, 2, 1},
                            {{{9, 9, 9}, {10, 10, 9}}, 3, 1}},
                           {0, 0, 1, 2});
    EXPECT_NEAR(epo(scene, bvh, kCosts).value, bruteForceEpo(scene, bvh, kCosts), 1e-12);
    // Triangle 1 (area 2) in the left inner node and its right leaf; triangle 0's right part (area 2) in the
    // right inner node and its left leaf.
    EXPECT_DOUBLE_EQ(epo(scene, bvh, kCosts).value, (2 + 3 + 2 + 3) * 2 / 10.5);
}

TEST(Epo, isZeroWithoutArea) {
    const Scene scene = sceneOf(std::vector<Triangle>(9, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(epo(scene, buildMedian(scene, {}), kCosts).value, 0);
    EXPECT_EQ(epo(scene, buildMedian(scene, {}), kCosts, {.exactUpTo = 0}).value, 0);
}

TEST(Epo, equalsBruteForceOnSmallScenes) {
    for (const uint32_t count : {1u, 2u, 7u, 120u})
        for (const float size : {0.05f, 0.5f, 3.0f}) {
            const Scene scene = sceneOf(randomTriangles(count, 1, size, count));
            const Bvh bvh = buildMedian(scene, {.costs = {}, .maxLeafSize = 3});
            const double expected = bruteForceEpo(scene, bvh, kCosts);
            EXPECT_NEAR(epo(scene, bvh, kCosts).value, expected, 1e-7 * (1 + expected))
                << count << " " << size;
        }
}

TEST(Epo, equalsBruteForceOnFlatAxisAlignedScenes) {
    const Scene scene = test::gridScene(9, [](float x, float) { return x < 4 ? 0.0f : 1.0f; });
    const Bvh bvh = buildMedian(scene, {.costs = {}, .maxLeafSize = 2});
    const double expected = bruteForceEpo(scene, bvh, kCosts);
    EXPECT_GT(expected, 1);
    EXPECT_NEAR(epo(scene, bvh, kCosts).value, expected, 1e-7 * expected);
}

TEST(Epo, sampledLiesWithinAFewStandardErrorsOfTheExactValue) {
    const Scene scene = sceneOf(randomTriangles(3000, 1, 0.2f));
    const Bvh bvh = buildMedian(scene, {});
    const double exact = epo(scene, bvh, kCosts).value;
    double squares = 0;
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const Epo sampled = epo(scene, bvh, kCosts, {.exactUpTo = 2999, .samples = 500, .seed = seed});
        EXPECT_FALSE(sampled.isExact);
        EXPECT_LE(sampled.sampledTriangles, 500u);
        EXPECT_GT(sampled.sampledTriangles, 300u);
        const double errors = (sampled.value - exact) / sampled.standardError;
        EXPECT_LT(std::abs(errors), 4);
        squares += errors * errors / 20;
    }
    // The estimated error must be the true error: the mean square of 20 standard normal draws is rarely
    // outside [0.4, 2].
    EXPECT_GT(squares, 0.4);
    EXPECT_LT(squares, 2);
}

TEST(Epo, isTheSameForAnyNumberOfThreads) {
    const Scene scene = sceneOf(randomTriangles(5000, 1, 0.2f));
    const Bvh bvh = buildMedian(scene, {});
    std::array<double, 3> exact, sampled;
    for (size_t threads = 1; threads <= 3; ++threads) {
        const ThreadLimit limit(threads);
        exact[threads - 1] = epo(scene, bvh, kCosts).value;
        sampled[threads - 1] = epo(scene, bvh, kCosts, {.exactUpTo = 0, .samples = 1000}).value;
    }
    EXPECT_EQ(exact[0], exact[1]);
    EXPECT_EQ(exact[0], exact[2]);
    EXPECT_EQ(sampled[0], sampled[1]);
    EXPECT_EQ(sampled[0], sampled[2]);
}

}  // namespace
}  // namespace bvhio
