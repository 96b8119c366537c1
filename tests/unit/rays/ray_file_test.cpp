#include "rays/ray_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/error.h"

namespace bvhio {
namespace {

std::string refusalOf(std::span<const std::byte> bytes) {
    try {
        decodeRays(bytes, "test.rays");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::invalid);
        return error.what();
    }
    return "accepted";
}

TEST(RayFile, refusesEveryTruncation) {
    const auto bytes = encodeRays(std::vector<Ray>(3));
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_NE(refusalOf(std::span(bytes).first(size)), "accepted") << size;
    EXPECT_EQ(refusalOf(bytes), "accepted");
}

TEST(RayFile, refusesWhatIsNotOne) {
    EXPECT_EQ(refusalOf({}), "test.rays: does not start with 'BVHRAYS1': it is not a file of rays");
    auto bytes = encodeRays(std::vector<Ray>(1));
    bytes[7] = std::byte{'2'};
    EXPECT_EQ(refusalOf(bytes), "test.rays: does not start with 'BVHRAYS1': it is not a file of rays");
}

TEST(RayFile, refusesMoreBytesThanItAnnounces) {
    auto bytes = encodeRays(std::vector<Ray>(2));
    bytes.push_back({});
    EXPECT_EQ(refusalOf(bytes), "test.rays: 1 bytes follow its 2 rays");
}

// A count near 2^64 must not overflow in a product, and must not be allocated.
TEST(RayFile, refusesHugeCounts) {
    auto bytes = encodeRays(std::vector<Ray>(1));
    for (const uint64_t count : {uint64_t(2), uint64_t(1) << 59, (uint64_t(1) << 59) + 1, ~uint64_t(0)}) {
        std::memcpy(bytes.data() + 8, &count, 8);
        EXPECT_EQ(refusalOf(bytes),
                  "test.rays: announces " + std::to_string(count) + " rays but holds 1: it was cut short");
    }
}

TEST(RayFile, keepsEveryBitOfOddRays) {
    std::vector<Ray> rays(2);
    rays[0] = {{1, -0.0f, 1e-45f}, -1, {std::nanf("7"), 0, 0}, -std::numeric_limits<float>::infinity()};
    const auto read = decodeRays(encodeRays(rays), "");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(std::memcmp(read.data(), rays.data(), 2 * sizeof(Ray)), 0);
    EXPECT_TRUE(decodeRays(encodeRays({}), "").empty());
}

TEST(RayFile, hasTheDocumentedLayout) {
    const auto bytes = encodeRays(std::vector<Ray>{{{1, 2, 3}, 4, {5, 6, 7}, 8}});
    ASSERT_EQ(bytes.size(), 48u);
    EXPECT_EQ(std::memcmp(bytes.data(), "BVHRAYS1\1\0\0\0\0\0\0\0", 16), 0);
    for (int i = 0; i < 8; ++i) {
        float value;
        std::memcpy(&value, bytes.data() + 16 + 4 * i, 4);
        EXPECT_EQ(value, i + 1);
    }
}

}  // namespace
}  // namespace bvhio
