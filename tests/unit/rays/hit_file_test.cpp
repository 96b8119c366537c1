#include "rays/hit_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "core/hash.h"
#include "unit/trace/brute_hits.h"

namespace bvhio {
namespace {

TEST(HitFile, refusesRaysAndCutFiles) {
    const auto bytes = encodeHits(std::vector<HitRecord>(2));
    auto other = bytes;
    std::memcpy(other.data(), "BVHRAYS1", 8);
    EXPECT_THROW(decodeHits(other, "x"), Error);
    EXPECT_THROW(decodeHits(std::span(bytes).first(bytes.size() - 1), "x"), Error);
    EXPECT_EQ(decodeHits(bytes, "x").size(), 2u);
}

// Fails if a hit has a triangle's index in the scene: dropped triangles and other geometries must not change
// ids.
TEST(HitFile, namesTrianglesByGeometryAndSource) {
    Scene scene = makeScene(std::vector<Vec3>(3), std::vector<TriangleIndices>(5, {0, 1, 2}));
    scene.geometries = {{"a", 0, 2}, {"points", 2, 0}, {"b", 2, 3}};
    scene.sourcePrimitives = std::vector<uint32_t>{0, 4, 1, 2, 9};
    const auto records = hitRecords(scene, std::vector<Hit>{{1.5f, 0.25f, 0.5f, 4}, {}, {2, 0, 0, 1}});
    EXPECT_EQ(records[0].primitive, 9u);
    EXPECT_EQ(records[0].geometry, 2u);
    EXPECT_EQ(records[0].instance, 0u);
    EXPECT_EQ(records[0].t, 1.5f);
    EXPECT_EQ(records[0].u, 0.25f);
    EXPECT_EQ(records[0].v, 0.5f);
    EXPECT_TRUE(records[1].isMiss());
    EXPECT_EQ(records[2].primitive, 4u);
    EXPECT_EQ(records[2].geometry, 0u);
}

TEST(HitFile, storesAMissAsDocumented) {
    const auto bytes = encodeHits(std::vector<HitRecord>(1));
    ASSERT_EQ(bytes.size(), 40u);
    const char miss[] =
        "BVHHITS1\1\0\0\0\0\0\0\0\0\0\x80\x7f\0\0\0\0\0\0\0\0"
        "\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff";
    EXPECT_EQ(std::memcmp(bytes.data(), miss, 40), 0);
}

TEST(HitFile, hashesWhatTheFileHoldsBehindItsHeader) {
    std::vector<HitRecord> records = {{1, 0.5f, 0.25f, 7, 1, 0}, {}};
    const uint64_t hash = hitHash(records);
    const auto bytes = encodeHits(records);
    EXPECT_EQ(hash, hash64(std::span(bytes).subspan(16)));
    records[0].t = std::nextafter(records[0].t, 2.0f);
    EXPECT_NE(hitHash(records), hash);
    std::swap(records[0], records[1]);
    EXPECT_NE(hitHash(records), hash);
}

}  // namespace
}  // namespace bvhio
