#include "core/clip_triangle.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace bvhio {
namespace {

/// Returns triangles of every awkward kind, of size `scale`.
std::vector<Triangle> awkwardTriangles(Random& random, float scale) {
    const auto point = [&](float spread) {
        const float x = random.uniform(-spread, spread), y = random.uniform(-spread, spread);
        return Vec3{x, y, random.uniform(-spread, spread)} * scale;
    };
    const Vec3 a = point(1), b = point(1), c = point(1), far = point(1000) + Vec3{scale, scale, scale} * 3000;
    const float s = random.uniform();
    std::vector<Triangle> triangles{
        {a, b, c},
        {a, b, a * (1 - s) + b * s},                            // a sliver, almost a segment
        {a, b, b + point(1e-6f)},                               // a needle
        {a, b, b},                                              // a segment
        {a, a, a},                                              // a point
        {{a.x, b.y, c.z}, {b.x, b.y, a.z}, {c.x, b.y, b.z}},    // in a plane across an axis
        {{a.x, 0, 0}, {b.x, 0, 0}, {c.x, c.y, 0}},              // at zero
        {far, far + point(1e-3f), far + point(1e-3f)},          // a few floats wide
        {a, {a.x + scale * 1e-6f, b.y, b.z}, {a.x, c.y, c.z}},  // thin along an axis
        {a * 1e-6f, b * 1e3f, c},                               // with sides of very different lengths
    };
    for (Triangle& t : triangles)
        for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v + Vec3{};  // no -0
    return triangles;
}

bool holds(const Aabb& box, const double (&p)[3]) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(p[axis] >= box.min[axis] && p[axis] <= box.max[axis])) return false;
    return true;
}

/// Returns a point of a triangle, rounded to double.
struct Sample {
    double at[3];
    Sample(const Triangle& t, double u, double v) {
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = t.v0[axis] * (1 - u - v) + t.v1[axis] * u + t.v2[axis] * v;
    }
};

std::vector<Sample> samplesOf(const Triangle& t, Random& random) {
    std::vector<Sample> samples{{t, 0, 0}, {t, 1, 0}, {t, 0, 1}};
    for (int i = 0; i < 60; ++i) {
        const double u = random.uniform(), v = random.uniform();
        samples.push_back(i % 4 == 0  ? Sample(t, u, 0)
                          : u + v > 1 ? Sample(t, 1 - u, 1 - v)
                                      : Sample(t, u, v));
    }
    return samples;
}

/// Returns the boxes of the parts into which random cuts divide a triangle.
std::vector<Aabb> cutUp(const Triangle& t, Random& random, int cuts) {
    std::vector<Aabb> parts{bounds(t)};
    for (int i = 0; i < cuts; ++i) {
        const size_t which = random.below(uint32_t(parts.size()));
        const Aabb box = parts[which];
        const int axis = int(random.below(3));
        const float s = random.uniform();
        // Some cuts go through a corner, where rounding is hardest.
        const float plane = random.below(4) == 0 ? t.v1[axis] : box.min[axis] * (1 - s) + box.max[axis] * s;
        Aabb low = box, high = box;
        low.max[axis] = std::min(low.max[axis], plane);
        high.min[axis] = std::max(high.min[axis], plane);
        parts.erase(parts.begin() + std::ptrdiff_t(which));
        for (const Aabb& half : {low, high}) {
            const Aabb part = intersection(partBounds(t, half), box);
            if (!part.isEmpty()) parts.push_back(part);
        }
    }
    return parts;
}

// If a point of a triangle is in no part's box, the picture has a hole there.
TEST(ClipTriangle, partsHoldEveryPoint) {
    Random random(1);
    for (const float scale : {1.0f, 1e6f, 1e30f, 1e-6f, 1e-30f, 1e-40f})
        for (int round = 0; round < 60; ++round)
            for (const Triangle& t : awkwardTriangles(random, scale)) {
                const std::vector<Aabb> parts = cutUp(t, random, 12);
                ASSERT_FALSE(parts.empty());
                for (const Sample& sample : samplesOf(t, random)) {
                    double p[3];
                    std::copy(sample.at, sample.at + 3, p);
                    // The sample itself is rounded, so it may lie outside the triangle's own bounds.
                    for (int axis = 0; axis < 3; ++axis)
                        p[axis] = std::clamp<double>(p[axis], bounds(t).min[axis], bounds(t).max[axis]);
                    bool held = false;
                    for (const Aabb& part : parts) held |= holds(part, p);
                    ASSERT_TRUE(held) << "scale " << scale << " round " << round;
                }
            }
}

TEST(ClipTriangle, partsStayWithinTheTriangleAndAFloatOfTheBox) {
    Random random(2);
    for (int round = 0; round < 1000; ++round)
        for (const Triangle& t : awkwardTriangles(random, 1)) {
            const Aabb whole = bounds(t);
            Aabb within = whole;
            for (int axis = 0; axis < 3; ++axis) {
                const float a = random.uniform(), b = random.uniform();
                within.min[axis] = whole.min[axis] + (whole.max[axis] - whole.min[axis]) * std::min(a, b);
                within.max[axis] = whole.min[axis] + (whole.max[axis] - whole.min[axis]) * std::max(a, b);
            }
            const Aabb part = partBounds(t, within);
            if (part.isEmpty()) continue;
            EXPECT_TRUE(whole.contains(part));
            const float largest =
                std::max({std::abs(whole.min.x), std::abs(whole.min.y), std::abs(whole.min.z),
                          std::abs(whole.max.x), std::abs(whole.max.y), std::abs(whole.max.z)});
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(part.min[axis], within.min[axis] - largest * 0x1p-22f);
                EXPECT_LE(part.max[axis], within.max[axis] + largest * 0x1p-22f);
                EXPECT_FALSE(part.min[axis] == 0 && std::signbit(part.min[axis]));
            }
        }
}

// Here and below, the overlap of the boxes would be 1 x 1. Cutting gives less.
TEST(ClipTriangle, boundsAreTight) {
    const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const Aabb corner = partBounds(t, {{3, 0, -1}, {4, 4, 1}});
    EXPECT_NEAR(corner.max.y, 1, 1e-6);
    EXPECT_NEAR(corner.min.x, 3, 1e-6);
    EXPECT_EQ(corner.max.x, 4);
    EXPECT_EQ(corner.min.z, 0);
    EXPECT_EQ(corner.max.z, 0);
    // Six planes at once.
    const Triangle slanted{{0, 0, 0}, {4, 4, 4}, {4, 0, 4}};
    const Aabb inside = partBounds(slanted, {{1, 0.5f, 0}, {2, 3, 1.5f}});
    EXPECT_NEAR(inside.min.x, 1, 1e-6);
    EXPECT_NEAR(inside.max.x, 1.5, 1e-6);
    EXPECT_NEAR(inside.max.y, 1.5, 1e-6);
    EXPECT_NEAR(inside.min.z, 1, 1e-6);
}

TEST(ClipTriangle, whatMissesTheBoxIsEmpty) {
    const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    EXPECT_TRUE(partBounds(t, {{3, 3, 0}, {4, 4, 0}}).isEmpty());  // in its bounds, beyond its longest edge
    EXPECT_TRUE(partBounds(t, {{5, 0, 0}, {6, 1, 0}}).isEmpty());
    EXPECT_FALSE(partBounds(t, {{2, 2, 0}, {4, 4, 0}}).isEmpty());  // touches it
    EXPECT_FALSE(partBounds(t, {{4, 0, 0}, {9, 1, 1}}).isEmpty());
}

}  // namespace
}  // namespace bvhio
