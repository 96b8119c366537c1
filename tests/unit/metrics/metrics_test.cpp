#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include "common/test_scenes.h"
#include "trace/step_aabb.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// A tree of two leaves: triangles 0 and 1 are at z = 0 and z = 1 above the unit square, and triangle 2 is
/// far along x. Rays along -z see all of them from above.
struct TwoLeaves {
    Scene scene = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                 {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                 {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}});
    EncodedBvh bvh = make();

    static EncodedBvh make() {
        AlignedVector<Node> nodes(4);
        nodes[0] = {{{0, 0, 0}, {6, 1, 1}}, 2, 0};
        nodes[1] = {};
        nodes[2] = {{{0, 0, 0}, {1, 1, 1}}, 0, 2};
        nodes[3] = {{{5, 0, 0}, {6, 1, 0}}, 2, 1};
        return AabbForm(Bvh{std::move(nodes), std::vector<uint32_t>{0, 1, 2}});
    }
};

TEST(Metrics, matchHandWorkedCounts) {
    const TwoLeaves two;
    const Ray rays[] = {
        {{0.25f, 0.25f, 9}, 0, {0, 0, -1}, kInf},  // root, pair, left leaf
        {{5.25f, 0.25f, 9}, 0, {0, 0, -1}, kInf},  // root, pair, right leaf
        {{3, 0.25f, 9}, 0, {0, 0, -1}, kInf},      // root, pair
        {{-3, 0.25f, 9}, 0, {0, 0, -1}, kInf},     // root
        {{0, 0.25f, 9}, 0, {0, 0, 0}, kInf},       // nothing: misses by definition
    };
    for (const QueryKind query : {QueryKind::closest, QueryKind::any}) {
        std::vector<RayCounts> perRay(5);
        const TraversalCounts counts = Tracer(two.scene, two.bvh).measure(rays, query, perRay).counts;
        EXPECT_EQ(counts.rays, 5u);
        EXPECT_EQ(counts.hits, 2u);
        EXPECT_DOUBLE_EQ(counts.nc(), (3 + 3 + 3 + 1) / 5.0);
        EXPECT_DOUBLE_EQ(counts.lc(), 2 / 5.0);
        EXPECT_DOUBLE_EQ(counts.tc(),
                         3 / 5.0);  // an any-hit query that ends at the first triangle counts its leaf's two
        EXPECT_DOUBLE_EQ(counts.aoc(), 24 * 10 / 5.0);
        EXPECT_DOUBLE_EQ(counts.blb(), (4 * 32 + 3 * 64 + 3 * 52) / 5.0);
        EXPECT_DOUBLE_EQ(counts.lcv(), std::sqrt(2 / 5.0 - 4 / 25.0));
        EXPECT_EQ(counts.records, 7u);
        EXPECT_EQ(counts.stackOperations, 0u);
        EXPECT_EQ(perRay[0].boxTests, 3u);
        EXPECT_EQ(perRay[0].leaves, 1u);
        EXPECT_EQ(perRay[0].triangleTests, 2u);
        EXPECT_EQ(perRay[4].boxTests, 0u);
    }
}

TEST(Metrics, countPushesPopsAndWhatTheyMove) {
    const TwoLeaves two;
    const Ray along{{-1, 0.25f, 0.5f}, 0, {1, 0, -0.08f}, kInf};  // enters both leaves
    const TraversalCounts counts = Tracer(two.scene, two.bvh).measure({&along, 1}, QueryKind::closest).counts;
    EXPECT_EQ(counts.leaves, 2u);
    EXPECT_EQ(counts.stackOperations, 2u);
    EXPECT_EQ(counts.stackBytes, 2 * sizeof(HWY_NAMESPACE::Entered<HWY_NAMESPACE::AabbCursor>));
}

TEST(Metrics, lcvOfEqualRaysIsZero) {
    TraversalCounts counts;
    counts.rays = 3'000'000'000;
    counts.leaves = 3'000'000'000 * 7;
    counts.leavesSquared = 3'000'000'000 * 49;
    EXPECT_EQ(counts.lcv(), 0);
    EXPECT_EQ(TraversalCounts{}.lcv(), 0);
}

TEST(Locality, matchesHandWorkedAddresses) {
    LocalityMetrics metrics(300000);
    for (const size_t offset : {0, 64, 192, 65, 4096 + 65}) metrics.recordFetched(offset, 64);
    metrics.finishRay();
    metrics.recordFetched(200000, 64);  // a ray's first fetch is no jump
    metrics.recordFetched(200000, 64);
    metrics.finishRay();
    const LocalityCounts counts = metrics.counts();
    // Distances 64, 128, 127, 4096, 0.
    EXPECT_EQ(counts.longJumps, (std::array<uint64_t, 5>{2, 1, 1, 0, 0}));
    // Blocks of 128 bytes: 0, 0, 1, 0, 32.
    EXPECT_EQ(counts.blockChanges, (std::array<uint64_t, 5>{3, 1, 1, 0, 0}));
    EXPECT_EQ(counts.workingSet, (std::array<uint64_t, 5>{4, 3, 3, 2, 2}));
}

TEST(Locality, joinsPartsOfARun) {
    LocalityMetrics one(1000), two(1000);
    one.recordFetched(0, 64);
    one.recordFetched(128, 64);
    two.recordFetched(128, 64);
    two.recordFetched(256, 64);
    one.add(two);
    EXPECT_EQ(one.counts().longJumps[0], 2u);
    EXPECT_EQ(one.counts().workingSet[0], 3u);
}

}  // namespace
}  // namespace bvhio
