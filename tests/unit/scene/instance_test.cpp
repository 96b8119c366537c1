#include "scene/instance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace bvhio {
namespace {

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

Vec3 randomPoint(Random& random, float size) {
    const float x = random.uniform(-size, size), y = random.uniform(-size, size);
    return {x, y, random.uniform(-size, size)};
}

Affine randomAffine(Random& random, float scale) {
    Affine result;
    for (float& number : result) number = random.uniform(-scale, scale);
    return result;
}

TEST(Instance, refusesTransformsThatCannotBeUndone) {
    EXPECT_TRUE(inverse(kIdentityAffine));
    EXPECT_FALSE(inverse({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}));  // flat
    EXPECT_FALSE(inverse({1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}));  // two parallel rows
    EXPECT_FALSE(inverse({kUnlimited, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_FALSE(inverse({1, 0, 0, NAN, 0, 1, 0, 0, 0, 0, 1, 0}));
    // The smallest and the largest floats, too: nothing may underflow or overflow.
    for (const float scale : {std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()}) {
        const auto back = inverse({scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0});
        ASSERT_TRUE(back);
        EXPECT_EQ(back->linear[4], 1 / double(scale));
    }
}

TEST(Instance, objectRayLeadsThroughTheImagesOfItsPoints) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const Affine affine = randomAffine(random, 4);
        const auto back = inverse(affine);
        ASSERT_TRUE(back);
        const Ray ray{randomPoint(random, 10), 0.5f, randomPoint(random, 1), 7};
        const Ray local = objectRay(*back, PreparedRay(ray));
        EXPECT_EQ(local.tMin, 0.5f);
        EXPECT_EQ(local.tMax, 7);
        const Vec3 again = place(affine, local.origin + local.direction * 2);
        // The way back to the world magnifies rounding in the mesh's space by the sums of the rows of |A|
        // |p'|.
        const float size = 12 * (length(local.origin) + 2 * length(local.direction)) + 20;
        EXPECT_LT(length(again - (ray.origin + ray.direction * 2)), size * 0x1p-21f) << i;
    }
}

TEST(Instance, identityChangesNoBit) {
    const Ray ray{{1e-20f, -3, 1e20f}, 0, {0, -1e-30f, 5}, 9};
    const Ray local = objectRay(*inverse(kIdentityAffine), PreparedRay(ray));
    EXPECT_EQ(local.origin, ray.origin);
    EXPECT_EQ(local.direction, ray.direction);
    EXPECT_EQ(place(kIdentityAffine, ray.origin), ray.origin);
}

TEST(Instance, boxHoldsEveryPlacedPointWithAMargin) {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Affine affine = randomAffine(random, i % 2 ? 1e-3f : 100);
        Aabb box = Aabb::empty();
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k) {
            points.push_back(randomPoint(random, 5));
            box.extend(points.back());
        }
        const Aabb placed = placedBox(affine, box);
        for (const Vec3& point : points) {
            const Vec3 p = place(affine, point);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LT(placed.min[axis], p[axis]);
                EXPECT_GT(placed.max[axis], p[axis]);
            }
        }
    }
    const Aabb unit = placedBox(kIdentityAffine, {{-1, -1, 0}, {1, 1, 0}});
    EXPECT_EQ(unit.max.x, 1 + 0x1p-18f);
    EXPECT_EQ(unit.max.z, 0.0f);
    EXPECT_FALSE(std::signbit(unit.min.z));
}

TEST(Instance, boxStaysFinite) {
    constexpr float huge = std::numeric_limits<float>::max();
    const Aabb box =
        placedBox({huge, huge, 0, huge, 0, 1, 0, 0, 0, 0, 1, 0}, {{-huge, -huge, 1}, {huge, huge, 2}});
    EXPECT_EQ(box.min.x, -huge);
    EXPECT_EQ(box.max.x, huge);
}

}  // namespace
}  // namespace bvhio
