#include "core/intersect.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"

namespace bvhio {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr Aabb kUnitBox{{0, 0, 0}, {1, 1, 1}};

bool entersBox(const Ray& ray, const Aabb& box) {
    return !clipToBox(PreparedRay(ray), box, ray.tMax).isEmpty();
}

Hit hitOf(const Ray& given, const Triangle& triangle) {
    const PreparedRay ray(given);
    Hit hit;
    if (!ray.missesByDefinition() && hitTriangle(ray, triangle, ray.tMax, hit)) hit.primitive = 0;
    return hit;
}

TEST(IntersectBox, findsTheIntervalUpToItsSlack) {
    const RayInterval part = clipToBox(PreparedRay({{-1, 0.5f, 0.5f}, 0, {2, 0, 0}, kInf}), kUnitBox, kInf);
    EXPECT_NEAR(part.enter, 0.5f, 1e-6f);
    EXPECT_LE(part.enter, 0.5f);
    EXPECT_NEAR(part.exit, 1.0f, 1e-6f);
    EXPECT_GE(part.exit, 1.0f);
}

// 0 * infinity is a NaN. It must neither reject the box nor widen the interval of the other axes.
TEST(IntersectBox, acceptsParallelRaysThatRunInAFace) {
    for (const float zero : {0.0f, -0.0f})
        for (const float y : {0.0f, 1.0f}) {
            EXPECT_TRUE(entersBox({{-1, y, 0.5f}, 0, {1, zero, zero}, kInf}, kUnitBox));
            EXPECT_FALSE(entersBox({{-1, y, 2}, 0, {1, zero, zero}, kInf}, kUnitBox));
            EXPECT_FALSE(entersBox({{2, y, 0.5f}, 0, {1, zero, zero}, kInf}, kUnitBox));
        }
}

TEST(IntersectBox, rejectsParallelRaysBesideTheBoxForZerosOfBothSigns) {
    for (const float zero : {0.0f, -0.0f})
        for (const float y : {-1e-30f, 1.0000001f})
            EXPECT_FALSE(entersBox({{-1, y, 0.5f}, 0, {1, zero, zero}, kInf}, kUnitBox));
}

TEST(IntersectBox, respectsTheRaysLimits) {
    EXPECT_TRUE(entersBox({{-1, 0.5f, 0.5f}, 0, {1, 0, 0}, 1}, kUnitBox));
    EXPECT_FALSE(entersBox({{-1, 0.5f, 0.5f}, 0, {1, 0, 0}, 0.99f}, kUnitBox));
    EXPECT_TRUE(entersBox({{-1, 0.5f, 0.5f}, 2, {1, 0, 0}, 3}, kUnitBox));
    EXPECT_FALSE(entersBox({{-1, 0.5f, 0.5f}, 2.01f, {1, 0, 0}, 3}, kUnitBox));
}

// The entry and exit of a flat box are computed from the same plane. Without the slack, rounding could make
// the interval empty.
TEST(IntersectBox, holdsEveryPointOfTheRayThatLiesInIt) {
    Random random(7);
    const auto number = [&] { return random.uniform(-1, 1) * std::exp2(float(random.below(20)) - 10); };
    for (int i = 0; i < 200000; ++i) {
        const Ray ray{{number(), number(), number()}, 0, {number(), number(), number()}, kInf};
        const float t = std::abs(number());
        Aabb box;
        for (int axis = 0; axis < 3; ++axis) {
            // The two floats around the exact coordinate, or a larger box. Double holds the product exactly,
            // and the sum almost exactly.
            const double exact = ray.origin[axis] + double(ray.direction[axis]) * t;
            float below = float(exact);
            if (below > exact) below = std::nextafter(below, -kInf);
            const float above = below == exact ? below : std::nextafter(below, kInf);
            box.min[axis] = random.below(2) ? below : below - std::abs(number());
            box.max[axis] = random.below(2) ? above : above + std::abs(number());
        }
        const RayInterval part = clipToBox(PreparedRay(ray), box, kInf);
        ASSERT_LE(part.enter, t) << i;
        ASSERT_GE(part.exit, t) << i;
    }
}

// The proof that hits are the same for every tree depends on this.
TEST(IntersectBox, neverLosesByGrowing) {
    Random random(8);
    const auto number = [&] {
        return random.below(4) == 0 ? 0.0f : random.uniform(-1, 1) * std::exp2(float(random.below(60)) - 30);
    };
    for (int i = 0; i < 200000; ++i) {
        const Ray ray{{number(), number(), number()}, 0, {number(), number(), number()}, kInf};
        Aabb inner = Aabb::empty(), outer;
        inner.extend(Vec3{number(), number(), number()});
        inner.extend(Vec3{number(), number(), number()});
        outer = inner;
        for (int axis = 0; axis < 3; ++axis) {
            if (random.below(2)) outer.min[axis] = std::nextafter(outer.min[axis], -kInf);
            if (random.below(2)) outer.max[axis] += std::abs(number());
        }
        const PreparedRay prepared(ray);
        const RayInterval small = clipToBox(prepared, inner, 100), large = clipToBox(prepared, outer, 100);
        ASSERT_LE(large.enter, small.enter) << i;
        ASSERT_GE(large.exit, small.exit) << i;
    }
}

constexpr Triangle kTriangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

TEST(IntersectTriangle, givesTInUnitsOfTheDirectionAndWeightsOfV1AndV2) {
    for (const float side : {1.0f, -1.0f}) {
        const Hit hit = hitOf({{1, 2, 6 * side}, 0, {0, 0, -3 * side}, kInf}, kTriangle);
        EXPECT_FALSE(hit.isMiss());
        EXPECT_EQ(hit.t, 2);
        EXPECT_EQ(hit.u, 0.25f);
        EXPECT_EQ(hit.v, 0.5f);
    }
}

TEST(IntersectTriangle, hitsAtBothLimitsAndNotBeyond) {
    const auto at = [](float tMin, float tMax) {
        return !hitOf({{1, 1, 2}, tMin, {0, 0, -1}, tMax}, kTriangle).isMiss();
    };
    EXPECT_TRUE(at(2, 2));
    EXPECT_FALSE(at(std::nextafter(2.0f, 3.0f), kInf));
    EXPECT_FALSE(at(0, std::nextafter(2.0f, 1.0f)));
    EXPECT_TRUE(at(-1, 2));
}

// Fails if a t beyond the range of floats counts as a hit at infinity, which means a miss.
TEST(IntersectTriangle, missesWhereTOverflows) {
    EXPECT_TRUE(hitOf({{1, 1, 1}, 0, {0, 0, -1e-40f}, kInf}, kTriangle).isMiss());
}

// Fails if the shear, 1/3 here, is rounded to float: from this distance that moves the hit by half a unit.
TEST(IntersectTriangle, staysPreciseFarAway) {
    const Hit hit = hitOf({{1 - 0x1p24f, 1, -3 * 0x1p24f}, 0, {1, 0, 3}, kInf}, kTriangle);
    EXPECT_FALSE(hit.isMiss());
    EXPECT_EQ(hit.t, 0x1p24f);
    EXPECT_NEAR(hit.u, 0.25, 1e-6);
    EXPECT_NEAR(hit.v, 0.25, 1e-6);
}

TEST(IntersectTriangle, hitsAtItsOriginWithAPositiveZero) {
    for (const float side : {1.0f, -1.0f}) {
        const Hit hit = hitOf({{0, 0, 0}, 0, {0.1f, 0.2f, side}, kInf}, kTriangle);
        EXPECT_FALSE(hit.isMiss());
        EXPECT_EQ(hit.t, 0);
        EXPECT_FALSE(std::signbit(hit.t) || std::signbit(hit.u) || std::signbit(hit.v));
    }
}

// A tie belongs to both neighbours. If each could leave it to the other, both might.
TEST(IntersectTriangle, ownsItsEdgesAndCorners) {
    for (const Vec3 at : {Vec3{2, 0, 1}, {0, 2, 1}, {2, 2, 1}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}})
        for (const Triangle& t : {kTriangle, Triangle{kTriangle.v1, kTriangle.v0, kTriangle.v2}})
            EXPECT_FALSE(hitOf({at, 0, {0, 0, -1}, kInf}, t).isMiss()) << at.x << ' ' << at.y;
}

TEST(IntersectTriangle, countsANegativeTMinAsZero) {
    EXPECT_TRUE(hitOf({{1, 1, -1}, -5, {0, 0, -1}, kInf}, kTriangle).isMiss());
    EXPECT_TRUE(hitOf({{1, 1, -1}, -kInf, {0, 0, -1}, kInf}, kTriangle).isMiss());
}

TEST(IntersectTriangle, missesDegenerateAndEdgeOnTriangles) {
    EXPECT_TRUE(hitOf({{0, 0, 1}, 0, {0, 0, -1}, kInf}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).isMiss());
    EXPECT_TRUE(hitOf({{1, 0, 1}, 0, {0, 0, -1}, kInf}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).isMiss());
    EXPECT_TRUE(hitOf({{-1, 1, 0}, 0, {1, 0, 0}, kInf}, kTriangle).isMiss());
}

TEST(IntersectTriangle, missesByDefinition) {
    const Vec3 o{1, 1, 1}, d{0, 0, -1};
    ASSERT_FALSE(hitOf({o, 0, d, kInf}, kTriangle).isMiss());
    for (const Ray& ray :
         {Ray{{kNaN, 1, 1}, 0, d, kInf}, Ray{{1, -kInf, 1}, 0, d, kInf}, Ray{o, 0, {0, kNaN, -1}, kInf},
          Ray{o, 0, {0, 0, -kInf}, kInf}, Ray{o, 0, {0, -0.0f, 0}, kInf}, Ray{o, kNaN, d, kInf},
          Ray{o, 0, d, kNaN}, Ray{o, 2, d, 1.5f}, Ray{o, -2, d, -1}}) {
        EXPECT_TRUE(PreparedRay(ray).missesByDefinition());
        EXPECT_TRUE(hitOf(ray, kTriangle).isMiss());
    }
}

// Ties of the edge functions: a ray through a shared edge or corner hits one of the neighbours, for any
// winding of the triangles.
TEST(IntersectTriangle, leavesNoGapAtSharedEdges) {
    Random random(3);
    const auto point = [&](float size) {
        return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    for (int i = 0; i < 100000; ++i) {
        const Vec3 a = point(1), b = point(1), left = point(1) + Vec3{-9, 0, 0},
                   right = point(1) + Vec3{9, 0, 0};
        const float s = random.uniform(0.1f, 0.9f);
        const Vec3 target = a + (b - a) * (random.below(8) == 0 ? 0.5f : s);
        const Vec3 origin = target + Vec3{random.uniform(-0.2f, 0.2f), random.uniform(-0.2f, 0.2f), 50};
        const Ray ray{origin, 0, target - origin, kInf};
        // Seen from z, the triangles must lie on either side of the edge.
        if (std::abs(a.y - b.y) < 0.5f * std::abs(a.x - b.x) || std::abs(a.y - b.y) < 0.1f) continue;
        Triangle first{a, b, left};
        if (random.below(2)) std::swap(first.v0, first.v1);
        if (random.below(2)) std::swap(first.v1, first.v2);
        ASSERT_FALSE(hitOf(ray, first).isMiss() && hitOf(ray, {b, a, right}).isMiss()) << i;
    }
}

TEST(IntersectTriangle, agreesWithExactArithmeticAtEverySize) {
    Random random(4);
    for (const float scale : {1e-30f, 1e-18f, 1e-6f, 1.0f, 1e6f, 1e15f}) {
        const auto point = [&] {
            return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * scale;
        };
        for (int i = 0; i < 2000; ++i) {
            const Triangle triangle{point(), point(), point()};
            const Vec3 inside = triangle.v0 * 0.5f + triangle.v1 * 0.25f + triangle.v2 * 0.25f;
            const Vec3 origin = point() * 3;
            const Hit hit = hitOf({origin, 0, inside - origin, kInf}, triangle);
            const Vec3 n =
                cross((triangle.v1 - triangle.v0) * (1 / scale), (triangle.v2 - triangle.v0) * (1 / scale));
            if (std::abs(dot(normalize(n), normalize((inside - origin) * (1 / scale)))) < 0.05f) continue;
            ASSERT_FALSE(hit.isMiss()) << scale;
            ASSERT_NEAR(hit.t, 1, 1e-4) << scale;
            ASSERT_NEAR(hit.u, 0.25, 1e-3) << scale;
            ASSERT_NEAR(hit.v, 0.25, 1e-3) << scale;
        }
    }
}

}  // namespace
}  // namespace bvhio
