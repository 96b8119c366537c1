#include "compress/mvh_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "compress/mvh_build.h"
#include "core/parallel.h"
#include "stats/hashes.h"
#include "tree/sah_cost.h"
#include "tree/validate.h"

namespace bvhio {
namespace {

// Leaves from left to right, found by a walk from the root, own one run after another. Only the last one is
// short.
TEST(MvhShape, leavesOwnRunsFromLeftToRight) {
    for (const uint32_t leafSize : {1u, 3u, 4u, 16u})
        for (uint32_t count = 1; count <= 200; ++count) {
            const MvhShape shape(count, leafSize);
            ASSERT_EQ(shape.leafCount(), (count + leafSize - 1) / leafSize);
            uint32_t next = 0, deepest = 0;
            const auto walk = [&](const auto& self, uint32_t node, uint32_t below, uint32_t depth) -> void {
                deepest = std::max(deepest, depth);
                if (!shape.isLeaf(node)) {
                    const uint32_t left = MvhShape::leftCount(below, leafSize);
                    self(self, 2 * node + 1, left, depth + 1);
                    self(self, 2 * node + 2, below - left, depth + 1);
                    return;
                }
                ASSERT_LT(node, shape.nodeCount());
                const PrimitiveRange range = shape.primitiveRange(node);
                EXPECT_EQ(range.first, next);
                EXPECT_EQ(range.count, below);
                next += range.count;
                EXPECT_EQ(range.count, next == count ? count - range.first : leafSize);
            };
            walk(walk, 0, count, 0);
            EXPECT_EQ(next, count);
            EXPECT_EQ(shape.depth(), deepest);
        }
}

TEST(MvhShape, treesThatShareAnArrayDoNotOverlap) {
    for (const uint32_t leafSize : {1u, 3u, 4u, 7u}) {
        uint32_t first = 0, free = 0;
        for (uint32_t count = 1; count < 60; ++count) {
            const uint32_t nibble = mvhFirstNibble(first, leafSize);
            ASSERT_GE(nibble, free) << count;
            free = nibble + MvhShape(count, leafSize).innerCount();
            first += count;
        }
        EXPECT_LE(free, (first + leafSize - 1) / leafSize);
    }
}

// Each code moves planes by one product and one sum from the parent's. Axes take turns in the order of size.
TEST(MvhCuts, cutTheAxisWhoseTurnItIs) {
    const Aabb box{{0, 10, -1}, {2, 14, 1}};  // y is the longest; x and z are equal, so x counts as longer
    const MvhRule rule{0.5f, 0.25f, 3};
    const uint32_t axes[] = {1, 0, 2};
    for (const uint32_t turn : {0u, 1u, 2u}) {
        const MvhCuts cuts({box, turn}, rule);
        EXPECT_EQ(cuts.axis, axes[turn]);
        EXPECT_EQ(cuts.child({box, turn}, kMvhNone).bounds, box);
        EXPECT_EQ(cuts.child({box, turn}, kMvhNone).turn, (turn + 1) % 3);
        EXPECT_EQ(cuts.child({box, turn}, kMvhBoth).turn, 0u);
    }
    const MvhCuts cuts({box}, rule);
    EXPECT_EQ(cuts.child({box}, kMvhLow).bounds, (Aabb{{0, 12, -1}, {2, 14, 1}}));
    EXPECT_EQ(cuts.child({box}, kMvhHigh).bounds, (Aabb{{0, 10, -1}, {2, 12, 1}}));
    EXPECT_EQ(cuts.child({box}, kMvhBoth).bounds, (Aabb{{0, 11, -1}, {2, 13, 1}}));
    EXPECT_EQ(cuts.code({{0, 12, 0}, {1, 14, 1}}), kMvhLow);
    EXPECT_EQ(cuts.code({{0, 11.5f, 0}, {1, 12.5f, 1}}), kMvhBoth);
    EXPECT_EQ(cuts.code({{0, 10, 0}, {1, 13, 1}}), kMvhNone);
}

// The sizes of a huge box overflow, and zeta times infinity would give planes that are not finite.
TEST(MvhCuts, stayFiniteInHugeBoxes) {
    const Aabb box{{-3e38f, 0, 0}, {3e38f, 1, 1}};
    for (const uint32_t code : {kMvhNone, kMvhLow, kMvhHigh, kMvhBoth}) {
        const Aabb child = MvhCuts({box}, {}).child({box}, code).bounds;
        EXPECT_TRUE(isFinite(child.min) && isFinite(child.max));
        EXPECT_TRUE(box.contains(child));
        EXPECT_EQ(child == box, code == kMvhNone);
    }
}

TEST(MvhForm, takesTwoBitsANode) {
    for (const uint32_t leafSize : {1u, 4u, 5u}) {
        const Scene scene = test::sceneOf(test::randomTriangles(1001, 1, 0.1f));
        const MvhForm form = MvhForm::encode(scene, {}, {.leafSize = leafSize});
        const size_t bits = 2 * size_t(form.shape().nodeCount());
        EXPECT_GE(form.nodeBytes() * 8, bits);
        EXPECT_LT(form.nodeBytes() * 8, bits + 34);
    }
}

class MvhInScene : public testing::TestWithParam<test::TestScene> {};

// Boxes, compared as floats, hold what is below them, for all leaf sizes and zetas, even with few triangles.
TEST_P(MvhInScene, boxesHoldTheirTriangles) {
    const Scene scene = GetParam().make();
    for (const MvhBuild build : {MvhBuild::best, MvhBuild::paper})
        for (const uint32_t leafSize : {1u, 3u, 4u, 16u})
            for (const float zeta : {0.01f, 0.3f, 0.5f, 0.99f}) {
                const MvhForm form = MvhForm::encode(
                    scene, {}, {.leafSize = leafSize, .zeta = zeta, .zetaOfBoth = 0, .build = build});
                const Bvh bvh = form.decode();
                ASSERT_EQ(bvh.primitives.size(), scene.triangles.size());
                const Validation validation =
                    validate(bvh, uint32_t(scene.triangles.size()),
                             [&](std::span<const uint32_t> primitives, Aabb* boxes) {
                                 for (size_t i = 0; i < primitives.size(); ++i)
                                     boxes[i] = bounds(scene.triangle(primitives[i]));
                             });
                for (const Finding& finding : validation.findings) ADD_FAILURE() << finding.message;
                EXPECT_EQ(validation.depth, form.shape().depth());
            }
}

// Our build may not lose to the paper's in any scene.
TEST_P(MvhInScene, bestCostsNoMoreThanPaper) {
    const Scene scene = GetParam().make();
    for (const uint32_t leafSize : {1u, 4u}) {
        double costs[2];
        for (const MvhBuild build : {MvhBuild::best, MvhBuild::paper})
            costs[build == MvhBuild::paper] =
                sahCost(MvhForm::encode(scene, {}, {.leafSize = leafSize, .build = build}).decode(), {});
        EXPECT_LE(costs[0], costs[1] * 1.000001) << leafSize;
    }
}

TEST_P(MvhInScene, keepsATreeThatItDecodedTo) {
    const Scene scene = GetParam().make();
    const MvhForm form = MvhForm::encode(scene, {}, {.leafSize = 2, .build = MvhBuild::paper});
    const Bvh bvh = form.decode();
    const MvhForm again = MvhForm::encode(scene, bvh, form.options());
    EXPECT_EQ(again.options(), form.options());
    EXPECT_EQ(topologyHash(again.decode()), topologyHash(bvh));
    EXPECT_EQ(boundsHash(again.decode()), boundsHash(bvh));
}

INSTANTIATE_TEST_SUITE_P(Awkward, MvhInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

// Several trees share one array of primitives and one of nibbles. Each decodes to boxes that hold its
// triangles, whatever its neighbors are.
TEST(MvhForest, sharesItsArrays) {
    const Scene scene = test::sceneOf(test::randomTriangles(700, 1, 0.1f));
    std::vector<MvhReference> references = mvhReferences(scene);
    const MvhParameters parameters{4, {}};
    std::vector<uint32_t> words((references.size() + 4) / 4 / 8 + 1);
    struct Run {
        uint32_t first, count;
        Aabb root;
    };
    std::vector<Run> runs;
    for (uint32_t first = 0, count = 1; first < references.size(); first += count, count = count % 31 + 1) {
        count = std::min(count, uint32_t(references.size()) - first);
        const std::span<MvhReference> run(references.data() + first, count);
        Aabb root = Aabb::empty();
        for (const MvhReference& r : run) root.extend(r.box());
        orderMvh(run, root, parameters, MvhBuild::best);
        std::vector<uint8_t> nibbles(MvhShape(count, 4).innerCount());
        MvhCoder(run, root, 4).code(parameters.rule, nibbles.data());
        for (uint32_t i = 0; i < nibbles.size(); ++i) {
            const uint32_t nibble = mvhFirstNibble(first, 4) + i;
            words[nibble / 8] |= uint32_t(nibbles[i]) << nibble % 8 * 4;
        }
        runs.push_back({first, count, root});
    }
    for (const Run& run : runs) {
        const MvhShape shape(run.count, 4);
        const auto walk = [&](const auto& self, uint32_t node, const MvhBox& box) -> void {
            if (shape.isLeaf(node)) {
                const PrimitiveRange range = shape.primitiveRange(node);
                for (uint32_t i = 0; i < range.count; ++i)
                    EXPECT_TRUE(box.bounds.contains(references[run.first + range.first + i].box()));
                return;
            }
            const MvhCuts cuts(box, parameters.rule);
            const uint32_t codes = mvhNibble(words.data(), mvhFirstNibble(run.first, 4) + node);
            self(self, 2 * node + 1, cuts.child(box, codes & 3));
            self(self, 2 * node + 2, cuts.child(box, codes >> 2));
        };
        walk(walk, 0, {run.root});
    }
}

// The run is so long that several threads divide it.
TEST(MvhForm, isTheSameForAnyNumberOfThreads) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.01f));
    uint64_t hashes[2];
    for (const size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        hashes[threads - 1] = boundsHash(MvhForm::encode(scene, {}, {}).decode());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// If the longest axis cannot be cut, the paper's tree stalls: all boxes stay as large as the root's. Here
// each triangle is as long as the scene.
TEST(MvhForm, cutsAcrossLongTriangles) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 64; ++i) {
        const auto y = float(i % 8), z = float(i / 8);
        triangles.push_back({{-10, y, z}, {10, y, z}, {10, y + 1, z}});
    }
    const Scene scene = test::sceneOf(triangles);
    const auto cost = [&](MvhBuild build) {
        return sahCost(MvhForm::encode(scene, {}, {.leafSize = 1, .build = build}).decode(), {});
    };
    EXPECT_LT(cost(MvhBuild::best), 0.5 * cost(MvhBuild::paper));
}

}  // namespace
}  // namespace bvhio
