#include "build/top_down.h"

#include <gtest/gtest.h>

#include <cstring>

#include "common/test_scenes.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

Range wholeRange(const Scene& scene, Buffer<Reference> (&sides)[2]) {
    Range range;
    makeReferences(scene, sides[0], range.bounds);
    range.count = range.capacity = uint32_t(scene.triangles.size());
    sides[1] = Buffer<Reference>(range.count);
    return range;
}

/// The worst splitter: it splits off only the first reference.
struct OneOff {
    bool split(const ReferenceArrays& references, const Range& range, Range& left, Range& right, bool) const {
        const Reference* source = references.at(range);
        std::memcpy(static_cast<void*>(references.left(range)), source, range.count * sizeof(Reference));
        left.count = 1;
        right.count = range.count - 1;
        left.bounds = right.bounds = Box::empty();
        for (uint32_t i = 0; i < range.count; ++i) {
            Box box;
            std::memcpy(&box, source + i, sizeof box);
            (i == 0 ? left : right).bounds.extend(box);
        }
        return true;
    }
};

// Without the limit, there would be 20,000 splits below each other.
TEST(TopDown, keepsToTheDepthBoundWhateverTheSplitter) {
    const Scene scene = test::sceneOf(test::randomTriangles(20000, 1, 0.01f));
    BuildOptions options;
    options.maxLeafSize = 1;
    OneOff splitter;
    const Bvh bvh = TopDownBuild<OneOff>(options, splitter).build(scene);
    EXPECT_LE(depthOf(bvh), kMaxDepth);
    EXPECT_GT(depthOf(bvh), kMaxDepth / 2);  // halving starts no sooner than it must
    EXPECT_EQ(bvh.nodeCount(), 2 * scene.triangles.size() - 1);
}

TEST(TopDown, mayChooseUntilOnlyHalvingKeepsTheBound) {
    Range range;
    for (const uint32_t count : {2u, 3u, 4u, 5u, 1000u, 0x7FFFFFFFu}) {
        range.count = count;
        uint32_t levels = 0;  // as many as halving needs
        while ((uint64_t(1) << levels) < count) ++levels;
        range.depth = kMaxDepth - levels;
        // A split now leaves count - 1 references for one level less, which is enough only if these need one
        // level less.
        uint32_t rest = 0;
        while ((uint64_t(1) << rest) < count - 1) ++rest;
        EXPECT_EQ(mayChooseSplit(range), rest < levels) << count;
        --range.depth;
        EXPECT_TRUE(mayChooseSplit(range)) << count;
    }
}

TEST(TopDown, medianSplitsHalveByCentroidThenByPosition) {
    // Centroids at x = 3, 1, 1, 2, 1: the left half is the two of the lowest ids at 1.
    std::vector<Triangle> triangles;
    for (const float x : {3.0f, 1.0f, 1.0f, 2.0f, 1.0f})
        triangles.push_back({{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
    Buffer<Reference> sides[2];
    const Range range = wholeRange(test::sceneOf(triangles), sides);
    Range left, right;
    splitAtMedian({{sides[0].data(), sides[1].data()}}, range, left, right);
    ASSERT_EQ(left.count, 2u);
    ASSERT_EQ(right.count, 3u);
    const uint32_t expected[] = {1, 2, 0, 3, 4};
    for (uint32_t i = 0; i < 5; ++i) EXPECT_EQ(sides[1][i].primitive, expected[i]);
    EXPECT_EQ(left.bounds.toAabb(), (Aabb{{1, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(right.bounds.toAabb(), (Aabb{{1, 0, 0}, {3, 1, 1}}));

    Buffer<Reference> same[2];
    const Range coincident = wholeRange(test::coincidentScene(7), same);
    splitAtMedian({{same[0].data(), same[1].data()}}, coincident, left, right);
    EXPECT_EQ(left.count, 3u);
    EXPECT_EQ(right.count, 4u);
    for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(same[1][i].primitive, i);
}

}  // namespace
}  // namespace bvhio
