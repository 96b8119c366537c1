// Tests every form after a refit to a scene whose vertices moved: the tree must be the same, valid over the
// new triangles, and give the hits of brute force.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "file/form_chunks.h"
#include "scene/triangle_bounds.h"
#include "stats/hashes.h"
#include "trace/trace.h"
#include "tree/validate.h"

namespace bvhio {
namespace {

/// Returns the scene with each vertex moved by up to a quarter of the scene's extent, so that no triangle
/// keeps its shape.
Scene crumpled(const Scene& scene) {
    Aabb box = Aabb::empty();
    for (const Vec3& v : scene.vertices) box.extend(v);
    const Vec3 quarter = (box.max * 0.25f) - (box.min * 0.25f);
    Random random(7);
    std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
    for (Vec3& v : vertices)
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = v[axis] * 0.5f + quarter[axis] * random.uniform(-1, 1) + 0.0f;
    Scene moved = scene;
    moved.vertices = std::move(vertices);
    return moved;
}

class RefitInScene : public testing::TestWithParam<test::TestScene> {};

TEST_P(RefitInScene, keepsTheTreeAndFindsTheNewHits) {
    const Scene scene = GetParam().make(), moved = crumpled(scene);
    const std::vector<Ray> rays = test::awkwardRays(moved, 3, 4);
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(bruteForceClosestHit(moved, ray));
    for (const char* builder : {"binned", "spatial"})
        for (const FormChoice& form : forms()) {
            SCOPED_TRACE(testing::Message() << builder << ' ' << form.name);
            const Bvh bvh = choose(builders(), "builder", builder).function(scene, {});
            const EncodedBvh encoded = form.function(scene, bvh, {});
            const EncodedBvh refitted = refitTo(encoded, moved);
            EXPECT_EQ(formNameOf(refitted), form.name);
            EXPECT_EQ(optionsOf(refitted), optionsOf(encoded));
            const Bvh decoded = decode(refitted);
            EXPECT_EQ(topologyHash(decoded), topologyHash(decode(encoded)));
            for (const Finding& finding :
                 validate(decoded, uint32_t(moved.triangles.size()), boundsOfTriangles(moved)).findings)
                ADD_FAILURE() << finding.message;
            const Tracer tracer(moved, refitted);
            std::vector<Hit> hits(rays.size());
            tracer.closestHits(rays, hits);
            for (size_t i = 0; i < rays.size(); ++i)
                ASSERT_EQ(std::memcmp(&hits[i], &expected[i], sizeof(Hit)), 0) << "ray " << i;
        }
}

// If nothing moved, tight boxes must stay the same, bit by bit.
TEST_P(RefitInScene, ofUnmovedTrianglesChangesNothing) {
    const Scene scene = GetParam().make();
    const Bvh bvh = choose(builders(), "builder", "sweep").function(scene, {});
    for (const FormChoice& form : forms()) {
        SCOPED_TRACE(form.name);
        const EncodedBvh encoded = form.function(scene, bvh, {});
        EXPECT_EQ(boundsHash(decode(refitTo(encoded, scene))), boundsHash(decode(encoded)));
    }
}

INSTANTIATE_TEST_SUITE_P(Awkward, RefitInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
