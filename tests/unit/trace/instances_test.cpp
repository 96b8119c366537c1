// The hits of an instanced scene nearly equal those of the same scene with each triangle copied to its place.
#include <gtest/gtest.h>

#include "common/instanced_scenes.h"
#include "rays/hit_file.h"
#include "rays/surface_point.h"
#include "trace/queries.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

/// Rays towards the insides of triangles, from a few of their sizes away.
std::vector<Ray> raysAtTriangles(const Scene& flat, uint32_t count) {
    Random random(5);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const Triangle t = flat.triangle(random.below(uint32_t(flat.triangles.size())));
        const float u = random.uniform(0.1f, 0.4f), v = random.uniform(0.1f, 0.4f);
        const Vec3 target = t.v0 * (1 - u - v) + t.v1 * u + t.v2 * v;
        const Vec3 extent = bounds(t).extent();
        const float size = 3 * std::max({extent.x, extent.y, extent.z});
        if (size == 0) continue;
        const float x = random.uniform(-size, size), y = random.uniform(-size, size);
        const Vec3 away{x, y, random.uniform(-size, size)};
        rays.push_back({target + away, 0, away * -0.5f});
    }
    return rays;
}

TEST(Instances, hitsAreThoseOfTheFlattenedScene) {
    for (const test::InstancedScene& row : test::instancedScenes()) {
        SCOPED_TRACE(row.name);
        const Scene scene = shareMeshes(row.imported, {}), flat = flatten(row.imported, {});
        const std::vector<Ray> rays = raysAtTriangles(flat, 300);
        size_t hits = 0, others = 0;
        for (const Ray& ray : rays) {
            const Hit hit = bruteForceClosestHit(scene, ray), expected = bruteForceClosestHit(flat, ray);
            EXPECT_EQ(bruteForceAnyHit(scene, ray), !hit.isMiss());
            hits += !hit.isMiss();
            // A ray that passes close to an edge may hit or miss.
            others += hit.isMiss() != expected.isMiss() || hit.primitive != expected.primitive ||
                      std::fabs(hit.t - expected.t) > 1e-5f * expected.t;
        }
        EXPECT_GT(hits, rays.size() * 9 / 10);
        EXPECT_LE(others, rays.size() / 100);
    }
}

// Light must not leak through the surface it starts on, nor be blocked by it.
TEST(Instances, surfacePointsLieOnTheViewersSide) {
    for (const test::InstancedScene& row : test::instancedScenes()) {
        SCOPED_TRACE(row.name);
        const Scene scene = shareMeshes(row.imported, {});
        for (const Ray& ray : raysAtTriangles(flatten(row.imported, {}), 200)) {
            const Hit hit = bruteForceClosestHit(scene, ray);
            if (hit.isMiss()) continue;
            const SurfacePoint point = surfacePoint(scene, ray, hit);
            EXPECT_LE(dot(point.normal, Vec3d(ray.direction)), 0);
            const Vec3d up = point.normal * double(length(ray.direction));
            const Hit above = bruteForceClosestHit(scene, {point.origin, 0, Vec3(up)});
            EXPECT_NE(above.primitive, hit.primitive);
            const Hit below = bruteForceClosestHit(scene, {point.origin, 0, Vec3(up * -1)});
            EXPECT_FALSE(below.isMiss());
        }
    }
}

// A hit must lie in its instance's box. Traversal may find triangles in front of that box.
TEST(Instances, hitsBeforeTheInstancesBoxDoNotCount) {
    const PreparedRay ray(Ray{{0, 0, 0}, 0, {0, 0, 1}});
    ClosestHitQuery query(ray);
    InstanceQuery<ClosestHitQuery> within(query, 2, 10);
    within.offer({1.5f, 0, 0, 3});
    EXPECT_TRUE(query.result().isMiss());
    within.offer({2, 0, 0, 3});
    EXPECT_EQ(query.result().primitive, 13u);
}

// Ids count through instances; records give each triangle its geometry as the flattened scene has it.
TEST(Instances, recordsNameInstanceGeometryAndTriangle) {
    const Mesh pair{"pair", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    ImportedScene imported{{pair}, {}};
    for (int i = 0; i < 3; ++i) {
        const Transform up{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 2.0 * i};
        imported.instances.push_back({0, up});
        imported.instances.push_back({0, up, "", true});
    }
    const Scene scene = shareMeshes(imported, {});
    ASSERT_EQ(scene.instances.size(), 3u);
    // The second geometry of a mesh lies in the first: the lower id wins.
    const std::vector<Hit> hits{bruteForceClosestHit(scene, {{0.75f, 0.75f, 1}, 0, {0, 0, 1}}), Hit{}};
    const auto records = hitRecords(scene, hits);
    EXPECT_EQ(hits[0].primitive, 5u);
    EXPECT_EQ(records[0].t, 1);
    EXPECT_EQ(records[0].instance, 1u);
    EXPECT_EQ(records[0].geometry, 2u);
    EXPECT_EQ(records[0].primitive, 1u);
    EXPECT_TRUE(records[1].isMiss());
    EXPECT_EQ(scene.primitiveId(11).instance, 2u);
    EXPECT_EQ(scene.primitiveId(11).geometry, 5u);
}

}  // namespace
}  // namespace bvhio
