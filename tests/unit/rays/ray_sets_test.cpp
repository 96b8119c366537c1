#include "rays/ray_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "core/hash.h"
#include "core/parallel.h"
#include "unit/trace/brute_hits.h"

namespace bvhio {
namespace {

const Camera kCamera{{0, 0, 4}, {0, 0, 0}, 40, {0, 1, 0}};

TEST(RaySets, refuseUnknownNamesAndTooMany) {
    const Scene ball = makeBall(1, {});
    EXPECT_THROW(makeRaySet("secondary", ball, {}, bruteForce(ball)), Error);
    EXPECT_THROW(makeRaySet("random", ball, {.count = kMaxRays + 1, .camera = kCamera}, bruteForce(ball)),
                 Error);
    EXPECT_THROW(
        makeRaySet("primary", ball, {.resolution = {65536, 65536}, .camera = kCamera}, bruteForce(ball)),
        Error);
    EXPECT_THROW(makeRaySet("diffuse", ball, {.count = ~uint64_t(0), .camera = kCamera}, bruteForce(ball)),
                 Error);
    EXPECT_THROW(makeRaySet("ao", ball, {.count = kAoRays - 1, .camera = kCamera}, bruteForce(ball)), Error);
}

TEST(RaySets, resolutionIsReadStrictly) {
    EXPECT_EQ(parseResolution("640x480"), (Resolution{640, 480}));
    for (const char* bad :
         {"", "640", "640x", "x480", "640X480", "640x480x", "0x5", "5x0", "-1x5", "65537x1", "9999999999x1"})
        EXPECT_THROW(parseResolution(bad), Error) << bad;
}

TEST(RaySets, areSane) {
    const Scene ball = makeBall(1, {});
    for (const RaySetChoice& row : raySets()) {
        const RaySet set =
            makeRaySet(row.name, ball, {.resolution = {40, 30}, .camera = kCamera}, bruteForce(ball));
        ASSERT_GT(set.rays.size(), 300u) << row.name;
        ASSERT_TRUE(set.pixels.empty() || set.pixels.size() == set.rays.size()) << row.name;
        for (const uint32_t pixel : set.pixels) ASSERT_LT(pixel, 40u * 30);
        for (const Ray& ray : set.rays) {
            ASSERT_NEAR(length(Vec3d(ray.direction)), 1, 1e-6) << row.name;
            ASSERT_TRUE(isFinite(ray.origin)) << row.name;
            ASSERT_EQ(ray.tMin, 0) << row.name;
            ASSERT_GT(ray.tMax, 0) << row.name;
        }
    }
}

TEST(RaySets, countBoundsEachSet) {
    const Scene ball = makeBall(1, {});
    for (const RaySetChoice& row : raySets())
        for (const uint64_t count : {4, 11, 100, 1000, 4095}) {
            const RaySet set =
                makeRaySet(row.name, ball, {.count = count, .camera = kCamera}, bruteForce(ball));
            EXPECT_LE(set.rays.size(), count) << row.name;
            if (row.name == "random") {
                EXPECT_EQ(set.rays.size(), count);
            } else if (row.name == "primary") {
                EXPECT_GE(set.rays.size(), count * 9 / 10);
            }
        }
}

// These hashes are frozen: rays are the same for every machine, compiler and number of threads. A change here
// changes what all figures measure.
TEST(RaySets, areTheSameForAnyThreadsAndFrozen) {
    const Scene ball = makeBall(1, {0.25f, -3, 100});
    const std::map<std::string_view, uint64_t> frozen = {{"primary", 0x8B2B499DB9B683B8ull},
                                                         {"shadow", 0xB17F00A0EC9C38B3ull},
                                                         {"ao", 0xDDDC8F19EE6CE770ull},
                                                         {"diffuse", 0x9A290D35A26AA718ull},
                                                         {"random", 0xDDBB4A253A44F988ull}};
    for (const RaySetChoice& row : raySets()) {
        const auto make = [&](uint64_t seed) {
            return makeRaySet(row.name, ball, {.resolution = {120, 90}, .seed = seed}, bruteForce(ball)).rays;
        };
        const auto rays = make(1);
        EXPECT_EQ(hash64(std::as_bytes(std::span(rays))), frozen.at(row.name)) << row.name;
        const ThreadLimit one(1);
        const auto again = make(1);
        ASSERT_EQ(rays.size(), again.size()) << row.name;
        EXPECT_EQ(std::memcmp(rays.data(), again.data(), rays.size() * sizeof(Ray)), 0) << row.name;
        const auto other = make(2);
        const bool seeded = row.name != "primary" && row.name != "shadow";
        EXPECT_EQ(std::memcmp(rays.data(), other.data(), rays.size() * sizeof(Ray)) != 0, seeded) << row.name;
    }
}

// From the lit side of a convex body no ray may hit the body again, at any size and place.
TEST(RaySets, secondaryRaysLeaveTheirSurface) {
    for (const float scale : {1e-6f, 0.2f, 1.0f, 1e6f})
        for (const float away : {0.0f, 100.0f}) {
            const Scene ball = makeBall(scale, Vec3{1, -2, 0.5f} * (scale * away));
            for (const char* name : {"ao", "diffuse"}) {
                const RaySet set = makeRaySet(name, ball, {.resolution = {40, 30}}, bruteForce(ball));
                ASSERT_GT(set.rays.size(), 300u);
                int met = 0;
                for (const Hit& hit : bruteHits(ball, set.rays)) met += !hit.isMiss();
                EXPECT_EQ(met, 0) << name << " scale " << scale << " away " << away;
            }
        }
}

TEST(RaySets, bouncesFollowTheCosine) {
    // A floor seen from above: the mean cosine to its normal is 2/3, and the mean of its square 1/2.
    const Scene floor = makeScene({{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}}, {{0, 1, 2}, {0, 2, 3}});
    const Camera above{{0, 5, 0.1f}, {0, 0, 0}, 40, {0, 1, 0}};
    for (const char* name : {"ao", "diffuse"}) {
        const RaySet set =
            makeRaySet(name, floor, {.resolution = {200, 200}, .camera = above}, bruteForce(floor));
        ASSERT_GE(set.rays.size(), 40000u);
        double mean = 0, square = 0, x = 0, z = 0;
        for (const Ray& ray : set.rays) {
            ASSERT_GE(ray.direction.y, 0);
            mean += ray.direction.y;
            square += ray.direction.y * ray.direction.y;
            x += ray.direction.x;
            z += ray.direction.z;
        }
        const double n = double(set.rays.size());
        EXPECT_NEAR(mean / n, 2.0 / 3, 0.005) << name;
        EXPECT_NEAR(square / n, 0.5, 0.005) << name;
        EXPECT_NEAR(x / n, 0, 0.01) << name;
        EXPECT_NEAR(z / n, 0, 0.01) << name;
    }
}

TEST(RaySets, aoIsAsLongAsDocumented) {
    const Scene ball = makeBall(1, {});
    const RaySet set = makeRaySet("ao", ball, {.resolution = {8, 6}, .camera = kCamera}, bruteForce(ball));
    const Vec3 extent = triangleBounds(ball).extent();
    EXPECT_NEAR(set.rays.at(0).tMax, 0.1 * length(extent), 1e-6);
    EXPECT_TRUE(set.anyHitIsEnough);
}

// Fails if the shadow ray goes beyond the light, or ends before the surface that casts the shadow.
TEST(RaySets, shadowRaysEndBeforeTheLight) {
    const Scene ball = makeBall(1, {});
    const RaySetOptions options{.resolution = {20, 15}, .camera = kCamera};
    const RaySet set = makeRaySet("shadow", ball, options, bruteForce(ball));
    const ClosestHits closest = bruteForce(ball);
    const Vec3d light(lightPosition({ball, triangleBounds(ball), kCamera, options, closest}));
    for (const Ray& ray : set.rays) {
        const double distance = length(light - Vec3d(ray.origin));
        EXPECT_LT(ray.tMax, distance);
        EXPECT_GT(ray.tMax, distance * 0.998);
        EXPECT_NEAR(length(Vec3d(ray.origin) + Vec3d(ray.direction) * distance - light), 0, 1e-5 * distance);
    }
}

TEST(RaySets, randomLinesCrossTheBoxEvenly) {
    // Of the lines that meet a convex body, the fraction that meets another one inside it is the ratio of
    // their surfaces.
    const Scene outer = makeScene({{0, 0, 0}, {2, 4, 8}, {2, 0, 8}}, {{0, 1, 2}});
    const RaySet set = makeRaySet("random", outer, {.count = 40000, .camera = kCamera}, bruteForce(outer));
    const Aabb inner{{1, 1, 1}, {2, 3, 2}};
    int crossed = 0;
    for (const Ray& ray : set.rays) {
        ASSERT_FALSE(Aabb({{0, 0, 0}, {2, 4, 8}}).contains({ray.origin, ray.origin}));
        double enter = 0, leave = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (double(inner.min[axis]) - ray.origin[axis]) / ray.direction[axis];
            const double b = (double(inner.max[axis]) - ray.origin[axis]) / ray.direction[axis];
            enter = std::fmax(enter, std::fmin(a, b)), leave = std::fmin(leave, std::fmax(a, b));
        }
        crossed += enter <= leave;
    }
    EXPECT_NEAR(crossed / 40000.0, halfArea(inner) / halfArea({{0, 0, 0}, {2, 4, 8}}), 0.006);
}

// Fails if rays start so far back, or the light is so far away, that a position overflows to infinity, and
// rays miss by definition.
TEST(RaySets, workWhereFloatsEnd) {
    const Scene ball = makeBall(1e38f, {});
    for (const RaySetChoice& row : raySets()) {
        const RaySet set = makeRaySet(row.name, ball, {.resolution = {20, 15}}, bruteForce(ball));
        ASSERT_FALSE(set.rays.empty()) << row.name;
        for (const Ray& ray : set.rays)
            ASSERT_TRUE(isFinite(ray.origin) && isFinite(ray.direction)) << row.name;
        if (row.name != "random") continue;
        int met = 0;
        for (const Hit& hit : bruteHits(ball, set.rays)) met += !hit.isMiss();
        EXPECT_GT(met, 100);
    }
}

TEST(RaySets, workOnAPoint) {
    const Scene point = makeScene({{5, 5, 5}}, {{0, 0, 0}});
    for (const RaySetChoice& row : raySets()) {
        const RaySet set = makeRaySet(row.name, point, {.count = 100}, bruteForce(point));
        for (const Ray& ray : set.rays)
            EXPECT_TRUE(isFinite(ray.origin) && isFinite(ray.direction)) << row.name;
    }
}

}  // namespace
}  // namespace bvhio
