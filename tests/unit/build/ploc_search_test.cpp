#include "build/ploc_search.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "common/test_scenes.h"
#include "core/buffer.h"

namespace bvhio {
namespace {

constexpr PartnerOffsets kOffsets;

// If two clusters had different numbers for each other, with equal distances each could choose another
// cluster, and no two would ever be joined.
TEST(PlocSearch, partnersShareTheNumberAndNobodyHasItTwice) {
    for (uint32_t i = 1000; i < 1000 + 4 * kPartners; ++i) {
        std::set<int> offsets;
        for (uint32_t number = 0; number < kPartners; ++number) {
            const int offset = kOffsets(i, uint8_t(number));
            offsets.insert(offset);
            EXPECT_EQ(kOffsets(i + uint32_t(offset), uint8_t(number)), -offset);
        }
        EXPECT_EQ(offsets.size(), kPartners);
        EXPECT_EQ(offsets.count(0), 0u);
        EXPECT_EQ(int(i) + kOffsets(i, 0), int(i ^ 1));
    }
}

float distance(const Reference& a, const Reference& b) {
    Box box = Box::empty();
    for (const Reference* r : {&a, &b})
        box.extend({{r->negatedMin[0], r->negatedMin[1], r->negatedMin[2], 0},
                    {r->max[0], r->max[1], r->max[2], 0}});
    return box.halfArea();
}

std::vector<uint8_t> found(const Buffer<Reference>& clusters) {
    const auto count = uint32_t(clusters.size());
    std::vector<uint8_t> nearest(count);
    for (uint32_t begin = 0; begin < count; begin += kSearchGrain)
        findNearest(clusters.data(), count, begin, std::min(begin + kSearchGrain, count), nearest.data());
    return nearest;
}

// Tests the ends of the order and of chunks, and counts of clusters that are not a multiple of the vector
// size.
TEST(PlocSearch, findsTheLeastCommonBoxWithinTheRadius) {
    for (const uint32_t count : {2u, 3u, 15u, 16u, 17u, 33u, kSearchGrain - 1, kSearchGrain + 1, 3000u}) {
        const Scene scene = test::sceneOf(test::randomTriangles(count, 1, 0.3f, count));
        Buffer<Reference> clusters;
        Box bounds;
        makeReferences(scene, clusters, bounds);
        const std::vector<uint8_t> nearest = found(clusters);
        for (uint32_t i = 0; i < count; ++i) {
            float least = std::numeric_limits<float>::infinity();
            for (uint32_t j = i - std::min(i, kRadius); j < std::min(count, i + kRadius + 1); ++j)
                if (j != i) least = std::min(least, distance(clusters[i], clusters[j]));
            const uint32_t partner = i + uint32_t(kOffsets(i, nearest[i]));
            ASSERT_LT(partner, count);
            // Equal except for the bits that hold the number.
            const auto expected = std::bit_cast<uint32_t>(least),
                       actual = std::bit_cast<uint32_t>(distance(clusters[i], clusters[partner]));
            ASSERT_EQ(actual / kPartners, expected / kPartners) << "cluster " << i << " of " << count;
        }
    }
}

TEST(PlocSearch, pairsUpEqualBoxes) {
    Buffer<Reference> clusters;
    Box bounds;
    makeReferences(test::coincidentScene(2501), clusters, bounds);
    const std::vector<uint8_t> nearest = found(clusters);
    for (uint32_t i = 0; i < 2500; ++i) ASSERT_EQ(int(i) + kOffsets(i, nearest[i]), int(i ^ 1));
}

}  // namespace
}  // namespace bvhio
