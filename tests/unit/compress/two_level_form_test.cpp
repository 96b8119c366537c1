#include "compress/two_level_form.h"

#include <gtest/gtest.h>

#include <set>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "stats/hashes.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

Scene soup() {
    return test::sceneOf(test::randomTriangles(700, 5, 0.1f));
}

TwoLevelForm::Options optionsFor(TlasForm tlas, BlasForm blas, uint32_t blasSize) {
    return {.tlasForm = tlas, .blasForm = blas, .blasSize = blasSize};
}

uint32_t primitivesBelow(const Bvh& bvh, const Node& node) {
    if (node.isLeaf()) return node.primitiveCount;
    return primitivesBelow(bvh, bvh.nodes[node.left()]) + primitivesBelow(bvh, bvh.nodes[node.right()]);
}

// A cut at subtrees that are too large, or smaller than possible, would change neither hits nor the joined
// tree. So this checks the cut itself.
TEST(TwoLevels, cutOffTheLargestSubtreesThatAreSmallEnough) {
    const Bvh bvh = builders()[0].function(soup(), {.costs = {}, .maxLeafSize = 3});
    const TwoLevels levels = cutTree(bvh, 20);
    const Bvh joined = joinLevels(levels, bvh.primitives);
    EXPECT_EQ(topologyHash(joined), topologyHash(bvh));
    EXPECT_EQ(levels.bottom.roots.size(), levels.top.nodes.size() / 2);
    for (size_t i = 0; i < levels.top.nodes.size(); ++i)
        if (i != 1) {
            EXPECT_EQ(primitivesBelow(joined, joined.nodes[i]) <= 20, levels.top.nodes[i].isLeaf()) << i;
        }
}

// Trees share one array of codes without a table: no two nodes may have the same byte.
TEST(NibbleRuns, giveEachInnerNodeAByteOfItsOwn) {
    for (const uint32_t leafSize : {1u, 3u, 4u, 7u, 16u})
        for (uint32_t i = 0; i < 4 * 40; ++i) {
            const NibbleRuns shape(leafSize);
            const uint32_t start = i % 4, count = i / 4 + 1;
            std::set<uint32_t> bytes;
            size_t inner = 0;
            const uint32_t total = start + 3 * count;
            std::vector<NibbleRun> waiting;
            for (uint32_t tree = 0; tree < 3; ++tree)
                waiting.push_back(shape.root({start + tree * count, count}));
            while (!waiting.empty()) {
                const NibbleRun run = waiting.back();
                waiting.pop_back();
                if (run.isLeaf()) continue;
                ++inner;
                bytes.insert(run.codes());
                EXPECT_EQ(shape.left(run).count + shape.right(run).count, run.count);
                waiting.push_back(shape.left(run));
                waiting.push_back(shape.right(run));
            }
            EXPECT_EQ(bytes.size(), inner) << start << ' ' << count;
            if (!bytes.empty()) {
                EXPECT_LT(*bytes.rbegin(), shape.byteCount(total));
            }
        }
}

TEST(NibbleBlases, takeAByteForEveryLeaf) {
    const Scene scene = test::sphereScene(60, 30);
    const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});
    for (const uint32_t leafSize : {4u, 16u}) {
        TwoLevelForm::Options options = optionsFor(TlasForm::quantized, BlasForm::mvh, 16);
        options.blasLeafSize = leafSize;
        const TwoLevelForm form = TwoLevelForm::encode(scene, bvh, options);
        EXPECT_EQ(form.options(), options);
        EXPECT_EQ(form.nodeBytes() - form.tlasBytes(), (scene.triangles.size() + leafSize - 1) / leafSize);
        EXPECT_LT(double(form.nodeBytes()), 2.0 * double(scene.triangles.size()));
    }
    EXPECT_LT(double(TwoLevelForm::encode(scene, bvh, {}).nodeBytes()), 0.4 * double(scene.triangles.size()));
}

// Both levels count, and leaves of the top level do not count as leaves.
TEST(TwoLevelForm, countsWhatOneTreeCounts) {
    const Scene scene = soup();
    const Bvh bvh = builders()[0].function(scene, {});
    const std::vector<Ray> rays = test::awkwardRays(scene, 1, 10);
    const EncodedBvh one = AabbForm(bvh);
    const EncodedBvh two = TwoLevelForm::encode(scene, bvh, optionsFor(TlasForm::aabb, BlasForm::aabb, 16));
    const TraversalCounts a = Tracer(scene, one).measure(rays, QueryKind::closest).counts;
    const TraversalCounts b = Tracer(scene, two).measure(rays, QueryKind::closest).counts;
    EXPECT_EQ(a.boxTests, b.boxTests);
    EXPECT_EQ(a.leaves, b.leaves);
    EXPECT_EQ(a.triangleTests, b.triangleTests);
    EXPECT_EQ(a.stackOperations, b.stackOperations);
    EXPECT_GT(b.records, a.records);  // roots
}

// A quantized tree has the same boxes in one level and in two: boxes below the cut must continue from the
// insets and the places above it, not from rounded boxes.
TEST(QuantizedBlases, goOnWhereTheTopEnds) {
    const Scene scene = soup();
    const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 7});
    const std::vector<Ray> rays = test::awkwardRays(scene, 1, 10);
    for (const uint32_t bits : {5u, 8u}) {
        TwoLevelForm::Options options = optionsFor(TlasForm::quantized, BlasForm::quantized, 9);
        options.bits = bits;
        const EncodedBvh one = QuantizedForm::encode(scene, bvh, {.bits = bits});
        const EncodedBvh two = TwoLevelForm::encode(scene, bvh, options);
        EXPECT_EQ(boundsHash(decode(two)), boundsHash(decode(one)));
        const TraversalCounts a = Tracer(scene, one).measure(rays, QueryKind::closest).counts;
        const TraversalCounts b = Tracer(scene, two).measure(rays, QueryKind::closest).counts;
        EXPECT_EQ(a.boxTests, b.boxTests);
        EXPECT_EQ(a.triangleTests, b.triangleTests);
        EXPECT_EQ(a.stackOperations, b.stackOperations);
    }
}

// Each code cuts along one axis, by the parts that nibbleCut states.
TEST(NibbleBlases, everyCodeLeavesTheOtherAxesAlone) {
    const InsetFrame frame({{0, 0, 0}, {16, 32, 64}});
    for (uint32_t code = 0; code < kNibbleCodes; ++code) {
        const Aabb box = frame.floats(cutBox(frame, {}, code));
        int changed = 0;
        for (int axis = 0; axis < 3; ++axis)
            changed += box.min[axis] != 0 || box.max[axis] != frame.bounds().max[axis];
        EXPECT_EQ(changed, code == 0 ? 0 : 1) << code;
    }
    EXPECT_EQ(frame.floats(cutBox(frame, {}, 1)), (Aabb{{7, 0, 0}, {16, 32, 64}}));
    EXPECT_EQ(frame.floats(cutBox(frame, {}, 9)), (Aabb{{0, 0, 0}, {16, 24, 64}}));
    EXPECT_EQ(frame.floats(cutBox(frame, {}, 15)), (Aabb{{0, 0, 16}, {16, 32, 48}}));
}

}  // namespace
}  // namespace bvhio
