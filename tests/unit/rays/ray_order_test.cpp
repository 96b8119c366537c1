#include "rays/ray_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace bvhio {
namespace {

std::vector<Ray> someRays() {
    std::vector<Ray> rays(30000);
    Random random(5);
    for (Ray& ray : rays) {
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = random.uniform(-5, 9);
            ray.direction[axis] = random.uniform(-1, 1);
        }
    }
    // Rays that miss by definition must not break a sort either.
    rays[7].origin.x = std::nanf("");
    rays[8].origin.y = -std::numeric_limits<float>::infinity();
    rays[9].direction = {};
    rays[10].direction.z = std::numeric_limits<float>::infinity();
    return rays;
}

TEST(RayOrder, isAPermutationForAnyRays) {
    for (const RayOrderChoice& row : rayOrders())
        for (const auto& rays : {std::vector<Ray>{}, std::vector<Ray>(1), std::vector<Ray>(5), someRays()}) {
            auto order = row.function(rays, 1);
            std::sort(order.begin(), order.end());
            ASSERT_EQ(order.size(), rays.size()) << row.name;
            for (uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i) << row.name;
        }
}

TEST(RayOrder, isTheSameForAnyNumberOfThreads) {
    const auto rays = someRays();
    for (const RayOrderChoice& row : rayOrders()) {
        const auto many = row.function(rays, 1);
        const ThreadLimit one(1);
        EXPECT_EQ(row.function(rays, 1), many) << row.name;
    }
}

TEST(RayOrder, shufflesBySeed) {
    const auto rays = someRays();
    const auto& shuffled = choose(rayOrders(), "ray order", "shuffled");
    EXPECT_NE(shuffled.function(rays, 1), shuffled.function(rays, 2));
    EXPECT_EQ(shuffled.function(rays, 2), shuffled.function(rays, 2));
}

TEST(RayOrder, mortonPutsNeighboursTogether) {
    const auto rays = someRays();
    const auto order = choose(rayOrders(), "ray order", "morton").function(rays, 1);
    double given = 0, sorted = 0;
    int turns = 0;
    for (size_t i = 12; i < order.size(); ++i) {
        given += length(rays[i].origin - rays[i - 1].origin);
        const Ray &a = rays[order[i - 1]], &b = rays[order[i]];
        if (!isFinite(a.origin) || !isFinite(b.origin)) continue;
        sorted += length(b.origin - a.origin);
        turns += dot(a.direction, b.direction) < 0;
    }
    EXPECT_LT(sorted, 0.4 * given);
    EXPECT_LE(turns, 8);  // the octant comes first
}

// Rays of one camera share an origin. Then the order must follow the directions.
TEST(RayOrder, mortonSortsRaysOfOneOriginByDirection) {
    auto rays = someRays();
    for (Ray& ray : rays) ray.origin = {1, 2, 3};
    const auto order = choose(rayOrders(), "ray order", "morton").function(rays, 1);
    double sum = 0;
    for (size_t i = 12; i < order.size(); ++i) {
        const Vec3 a = normalize(rays[order[i - 1]].direction), b = normalize(rays[order[i]].direction);
        if (isFinite(a) && isFinite(b)) sum += length(a - b);
    }
    EXPECT_LT(sum / order.size(), 0.1);
}

}  // namespace
}  // namespace bvhio
