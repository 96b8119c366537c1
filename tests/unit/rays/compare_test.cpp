#include "rays/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace bvhio {
namespace {

const HitRecord kHit{2, 0.25f, 0.5f, 3, 1, 0};

TEST(Compare, refusesOtherNumbersOfRays) {
    EXPECT_THROW(compareHits(std::vector<HitRecord>(2), std::vector<HitRecord>(3)), Error);
}

// Each field must be compared. Without one of them a wrong traversal could pass.
TEST(Compare, seesADifferenceInEachField) {
    std::vector<HitRecord> others(6, kHit);
    others[0].t = std::nextafter(2.0f, 3.0f);
    others[1].u = 0;
    others[2].v = 0;
    others[3].primitive = 4;
    others[4].geometry = 0;
    others[5].instance = 1;
    const HitComparison result = compareHits(std::vector<HitRecord>(6, kHit), others, {.maxListed = 4});
    EXPECT_EQ(result.rays, 6u);
    EXPECT_EQ(result.differing, 6u);
    ASSERT_EQ(result.listed.size(), 4u);
    EXPECT_EQ(result.listed[3].ray, 3u);
    EXPECT_EQ(result.listed[3].first.primitive, 3u);
    EXPECT_EQ(result.listed[3].second.primitive, 4u);
    EXPECT_DOUBLE_EQ(result.maxRelativeT, 0x1p-22 / (2 + 0x1p-22));
}

TEST(Compare, findsNothingInEqualHits) {
    const std::vector<HitRecord> hits = {kHit, {}, kHit};
    const HitComparison result = compareHits(hits, hits);
    EXPECT_EQ(result.differing, 0u);
    EXPECT_TRUE(result.listed.empty());
    EXPECT_EQ(result.maxRelativeT, 0);
}

TEST(Compare, toleranceForgivesTimesAndNamesButNotMisses) {
    std::vector<HitRecord> first(4, kHit), second(4, kHit);
    second[0].t = 2.001f;
    second[1].t = 2.1f;
    second[2].primitive = 9;
    second[3] = {};
    const HitComparison result = compareHits(first, second, {.relativeTolerance = 1e-3});
    EXPECT_EQ(result.differing, 2u);
    EXPECT_EQ(result.hitsAgainstMisses, 1u);
    EXPECT_EQ(result.listed[0].ray, 1u);
    EXPECT_EQ(result.listed[1].ray, 3u);
    EXPECT_NEAR(result.maxRelativeT, 0.1 / 2.1, 1e-6);
}

TEST(Compare, neverForgivesNaN) {
    std::vector<HitRecord> first(1, kHit), second(1, kHit);
    second[0].t = std::nanf("");
    EXPECT_EQ(compareHits(first, second, {.relativeTolerance = 1}).differing, 1u);
}

}  // namespace
}  // namespace bvhio
