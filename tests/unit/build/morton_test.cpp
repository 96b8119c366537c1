#include "build/morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "build/morton_sort.h"
#include "common/test_scenes.h"
#include "core/random.h"

namespace bvhio {
namespace {

/// Returns codes for sortCodes, in which the lowest bit is unused.
std::vector<uint64_t> randomCodes(uint32_t count, uint64_t mask, uint64_t seed) {
    Random random(seed);
    std::vector<uint64_t> codes(count);
    for (uint64_t& code : codes) {
        code = 0;
        for (int bit = 0; bit < 63; ++bit) code = code << 1 | (random.uniform(0, 1) < 0.5f);
        code = (code << 1) & mask;
    }
    return codes;
}

void expectSorted(const std::vector<uint64_t>& codes) {
    const auto count = uint32_t(codes.size());
    std::vector<uint32_t> order(count), expected(count);
    std::vector<uint8_t> levels(count);
    sortCodes(codes, order.data(), levels.data());
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t a, uint32_t b) { return codes[a] < codes[b]; });
    ASSERT_EQ(order, expected);
    for (uint32_t i = 0; i + 1 < count; ++i) {
        const uint64_t bits = codes[order[i]] ^ codes[order[i + 1]];
        const int level = bits != 0 ? std::countl_zero(bits) : 63 + std::countl_zero(i ^ (i + 1));
        ASSERT_EQ(int(levels[i]), level) << "place " << i;
    }
}

// Runs that fit the cache and runs that do not, of codes that differ in their high bits, low bits, or both.
TEST(SortCodes, isStableForAnyNumberOfCodesThatDifferAnywhere) {
    for (const uint32_t count : {1u, 2u, 3u, 31u, 33u, 1000u, 8192u, 8193u, 20000u, 100000u})
        for (const uint64_t mask :
             {~uint64_t(1), uint64_t(0), uint64_t(0xFFF) << 52, uint64_t(0xFFFF) << 1, uint64_t(6),
              uint64_t(0x00FF00FF00FF00FE), uint64_t(1) << 63, (uint64_t(0xFFFFFF) << 40) | 0xFFFE})
            ASSERT_NO_FATAL_FAILURE(expectSorted(randomCodes(count, mask, count))) << count << " " << mask;
}

// Many codes share all digits by which runs are distributed. Insertion alone would then take quadratic time.
TEST(SortCodes, copesWithCodesThatDifferOnlyFarBelowTheFirstDifference) {
    std::vector<uint64_t> codes = randomCodes(6000, 0xFFFFFFFE, 3);
    codes[5] |= uint64_t(1) << 62;
    expectSorted(codes);
}

uint64_t spread(uint64_t cell) {
    uint64_t bits = 0;
    for (int i = 0; i < 21; ++i) bits |= (cell >> i & 1) << (3 * i);
    return bits;
}

// The order of bits is x (highest), y, z, and all 21 bits of each matter.
TEST(MortonOrder, interleavesTheBitsOfTheAxes) {
    constexpr float kSide = 1 << 20;  // two cells per unit
    std::vector<Triangle> triangles{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                    {{kSide, kSide, kSide}, {kSide, kSide, kSide}, {kSide, kSide, kSide}}};
    Random random(7);
    for (int i = 0; i < 3000; ++i) {
        const float reach = i % 2 == 0 ? kSide : 8;
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::floor(random.uniform(0, reach) * 2) / 2;
        triangles.push_back({p, p, p});
    }
    std::vector<uint64_t> codes;
    for (const Triangle& t : triangles) {
        uint64_t cells[3];
        for (int axis = 0; axis < 3; ++axis) cells[axis] = uint64_t(std::min(t.v0[axis] * 2, 2 * kSide - 1));
        codes.push_back(spread(cells[0]) << 2 | spread(cells[1]) << 1 | spread(cells[2]));
    }
    std::vector<uint32_t> expected(triangles.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t a, uint32_t b) { return codes[a] < codes[b]; });
    const MortonOrder order = mortonOrder(test::sceneOf(triangles));
    EXPECT_EQ(std::vector<uint32_t>(order.triangles.data(), order.triangles.data() + expected.size()),
              expected);
}

// Denormals are scaled by the largest power of two that a float can hold. Twice that is infinite, and once
// made the grid's origin and extent infinite.
TEST(MortonOrder, isTheSameAtAnyScale) {
    Scene scene = test::sphereScene(40, 20);
    std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
    for (Vec3& v : vertices)  // few bits, which denormals can hold, too
        v = {std::round(v.x * 0x1p10f) + 0.0f, std::round(v.y * 0x1p10f) + 0.0f,
             std::round(v.z * 0x1p10f) + 0.0f};
    scene.vertices = std::vector<Vec3>(vertices);
    const MortonOrder expected = mortonOrder(scene);
    for (const float scale : {0x1p-149f, 0x1p-138f, 0x1p-136f, 0x1p-60f, 0x1p116f}) {
        std::vector<Vec3> scaled = vertices;
        for (Vec3& v : scaled) v = v * scale;
        scene.vertices = std::move(scaled);
        const MortonOrder order = mortonOrder(scene);
        EXPECT_TRUE(std::equal(order.triangles.data(), order.triangles.data() + order.triangles.size(),
                               expected.triangles.data()))
            << scale;
    }
}

// Importers keep vertices that no triangle uses: they must not make the grid too coarse.
TEST(MortonOrder, ignoresUnusedVertices) {
    const Scene scene = test::sphereScene(40, 20);
    for (const float far : {100.0f, 1e38f}) {
        std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
        vertices.push_back({far, -far, far});
        Scene larger = scene;
        larger.vertices = std::move(vertices);
        const MortonOrder a = mortonOrder(scene), b = mortonOrder(larger);
        EXPECT_EQ(a.scale, b.scale);
        EXPECT_TRUE(
            std::equal(a.triangles.data(), a.triangles.data() + a.triangles.size(), b.triangles.data()));
    }
}

}  // namespace
}  // namespace bvhio
