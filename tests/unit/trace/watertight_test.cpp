// No ray slips out of a closed mesh: not at edges or corners, at any size and at any place.
#include <gtest/gtest.h>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

Scene torusScene(uint32_t around, uint32_t across) {
    constexpr double kPi = 3.14159265358979323846;
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            const double a = 2 * kPi * i / around, b = 2 * kPi * j / across, r = 1 + 0.3 * std::cos(b);
            vertices.push_back({float(r * std::cos(a)), float(r * std::sin(a)), float(0.3 * std::sin(b))});
            const auto at = [&](uint32_t x, uint32_t y) { return x % around * across + y % across; };
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    const auto count = uint32_t(triangles.size());
    return {std::move(vertices), std::move(triangles), {{"torus", 0, count}}, {}};
}

/// A long room, one unit high: its flat walls have flat boxes.
Scene boxScene() {
    std::vector<Vec3> vertices;
    for (int i = 0; i < 8; ++i)
        vertices.push_back({i & 1 ? 40.0f : -40.0f, i & 2 ? 0.5f : -0.5f, i & 4 ? 3.0f : -3.0f});
    std::vector<TriangleIndices> triangles{{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 4, 5}, {0, 5, 1},
                                           {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return {std::move(vertices), std::move(triangles), {{"box", 0, 12}}, {}};
}

/// A sphere with dents: star-shaped around the origin.
Scene pebbleScene() {
    Scene sphere = test::sphereScene(40, 20);
    Random random(11);
    std::vector<Vec3> vertices(sphere.vertices.begin(), sphere.vertices.end());
    for (Vec3& v : vertices) v = v * random.uniform(0.6f, 1);
    sphere.vertices = std::move(vertices);
    return sphere;
}

struct ClosedMesh {
    const char* name;
    Scene (*make)();
    Vec3 (*inside)(Random&);  // a point inside
};

const ClosedMesh kMeshes[] = {
    {"sphere", [] { return test::sphereScene(60, 30); },
     [](Random& random) {
         return Vec3{random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f)};
     }},
    {"pebble", pebbleScene,
     [](Random& random) {
         return Vec3{random.uniform(-0.1f, 0.1f), random.uniform(-0.1f, 0.1f), 0};
     }},
    {"torus", [] { return torusScene(50, 20); },
     [](Random& random) {
         const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
         const Vec3 onRing = normalize(Vec3{x, y, 0} + Vec3{0, 1e-3f, 0});
         return onRing + Vec3{0, 0, random.uniform(-0.2f, 0.2f)};
     }},
    {"box", boxScene,
     [](Random& random) {
         // Some close to the walls, down to 1e-4 of the room's height.
         const float y = 0.5f - std::exp2(-random.uniform(1, 13)), z = 3 - std::exp2(-random.uniform(-1, 13));
         return Vec3{random.uniform(-39, 39), random.below(2) ? y : -y, random.below(2) ? z : -z};
     }},
};

class Watertight : public testing::TestWithParam<ClosedMesh> {};

TEST_P(Watertight, holdsEveryRayAimedAtEdgesAndCorners) {
    struct Place {
        float scale;
        Vec3 offset;  // in units of the mesh, before scaling
    };
    for (const Place& place :
         {Place{1, {}}, Place{1e-6f, {}}, Place{1e6f, {}}, Place{1e-20f, {}}, Place{1, {1000, -2000, 500}},
          Place{1e6f, {1000, 1000, 1000}}, Place{0.1f, {-300, 0, 0}}}) {
        SCOPED_TRACE(testing::Message() << "scale " << place.scale << " offset " << place.offset.x);
        Scene scene = GetParam().make();
        const auto put = [&](Vec3 p) { return (p + place.offset) * place.scale; };
        std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
        for (Vec3& v : vertices) v = put(v);
        scene.vertices = std::move(vertices);
        const EncodedBvh bvhs[] = {AabbForm(builders()[0].function(scene, {})),
                                   AabbForm(choose(builders(), "builder", "spatial").function(scene, {}))};

        Random random(uint64_t(place.scale * 10) + 1);
        std::vector<Ray> rays;
        while (rays.size() < 100000) {
            const Triangle t = scene.triangle(random.below(uint32_t(scene.triangles.size())));
            const Vec3 origin = put(GetParam().inside(random));
            const float s = random.uniform();
            for (const Vec3& target : {t.v0, t.v1, t.v0 * 0.5f + t.v1 * 0.5f, t.v1 * (1 - s) + t.v2 * s,
                                       t.v2 * (1 - s) + t.v0 * s}) {
                const Vec3 direction = target - origin;
                if (direction == Vec3{}) continue;
                rays.push_back({origin, 0, direction, std::numeric_limits<float>::infinity()});
                // Along an axis through the same edge, where sums and products are exact and ties are true.
                Vec3 axis{};
                axis[int(random.below(3))] = random.below(2) ? place.scale : -place.scale;
                rays.push_back({origin, 0, axis, std::numeric_limits<float>::infinity()});
            }
        }
        for (const EncodedBvh& bvh : bvhs) {
            std::vector<Hit> hits(rays.size());
            Tracer(scene, bvh).closestHits(rays, hits);
            size_t lost = 0;
            for (const Hit& hit : hits) lost += hit.isMiss();
            EXPECT_EQ(lost, 0u) << "of " << rays.size();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(ClosedMeshes, Watertight, testing::ValuesIn(kMeshes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
