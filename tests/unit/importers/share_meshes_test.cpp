#include <cmath>
#include <limits>

#include "unit/importers/import_helpers.h"

namespace bvhio {
namespace {

Mesh pairMesh(const std::string& name) {
    return {name, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 3}}, {{0, 1, 2}, {1, 3, 2}}};
}
const Mesh kPoints{"points", {{1, 1, 1}}, {}};

Transform scale(double x, double y, double z) {
    return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0};
}

/// Ids and places of all primitives are those of the flattened scene.
void expectFlattened(const Scene& scene, const ImportedScene& imported) {
    const Scene flat = flatten(imported, {});
    ASSERT_EQ(scene.primitiveCount(), flat.triangles.size());
    for (uint32_t i = 0; i < scene.primitiveCount(); ++i) {
        const auto id = scene.primitiveId(i), expected = flat.primitiveId(i);
        EXPECT_EQ(id.geometry, expected.geometry) << i;
        EXPECT_EQ(id.primitive, expected.primitive) << i;
        const Triangle a = scene.placedTriangle(i), b = flat.triangle(i);
        for (const auto& [p, q] : {std::pair{a.v0, b.v0}, {a.v1, b.v1}, {a.v2, b.v2}})
            EXPECT_LE(length(p - q), 1e-5f * (length(q) + 1)) << i;
    }
}

// Things of two parts, of one, and of none; the parts of one recur in another order.
TEST(ShareMeshes, makesAMeshOfWhatStandsTogether) {
    const ImportedScene imported{{triangleMesh("one"), pairMesh("pair"), kPoints},
                                 {{0, translation(0, 0, 1)},
                                  {1, translation(0, 0, 1), {}, true},
                                  {2, translation(5, 5, 5)},
                                  {1, translation(2, 0, 0)},
                                  {0, translation(0, 3, 0), "other"},
                                  {1, translation(0, 3, 0), {}, true},
                                  {2, translation(0, 3, 0), {}, true},
                                  {0, scale(-1, 1, 1)},
                                  {1, scale(-1, 1, 1), {}, true}}};
    const Scene scene = shareMeshes(imported, {});
    EXPECT_EQ(scene.meshes, (std::vector<SceneMesh>{{0, 2, 0, 3}, {2, 1, 3, 2}, {3, 3, 5, 3}}));
    ASSERT_EQ(scene.instances.size(), 4u);
    EXPECT_EQ(scene.instances[3].mesh, 0u);
    EXPECT_EQ(scene.instances[3].firstGeometry, 7u);
    EXPECT_EQ(scene.instances[3].firstPrimitive, 8u);
    EXPECT_EQ(scene.geometries[3].name, "other");
    EXPECT_EQ(scene.placedGeometryCount(), 9u);
    EXPECT_EQ(scene.primitiveId(5).instance, 2u);
    EXPECT_EQ(scene.triangles.size(), 8u);
    expectFlattened(scene, imported);
}

TEST(ShareMeshes, movesWhatItCannotPlaceIntoTheWorld) {
    const double skewed = 1 + 1e-4;  // two axes nearly parallel
    const ImportedScene imported{{pairMesh("pair")},
                                 {{0, translation(0, 0, 1)},
                                  {0, scale(1, 1, 0)},                                      // flat
                                  {0, Transform{1, 1, 0, 0, 1, skewed, 0, 0, 0, 0, 1, 0}},  // nearly flat
                                  {0, scale(1e-3, 1000, 1)},                                // fine
                                  {0, scale(1e-42, 1, 1)},  // rays would leave the floats
                                  {0, scale(1e-60, 1, 1)}}};
    const Scene scene = shareMeshes(imported, {});
    ASSERT_EQ(scene.instances.size(), 6u);
    std::vector<uint32_t> meshes;
    for (const SceneInstance& instance : scene.instances) {
        meshes.push_back(instance.mesh);
        if (instance.mesh != 0) {
            EXPECT_EQ(instance.objectToWorld, kIdentityAffine);
        }
    }
    EXPECT_EQ(meshes, (std::vector<uint32_t>{0, 1, 2, 0, 3, 4}));
    expectFlattened(scene, imported);

    // What is not finite in its place is refused, as when flattened.
    EXPECT_THROW(shareMeshes({{pairMesh("m")}, {{0, scale(1e39, 1, 1)}}}, {}), Error);
    EXPECT_THROW(shareMeshes({{pairMesh("m")}, {{0, scale(1, 1, 2e38)}}}, {}), Error);
    EXPECT_THROW(shareMeshes({{pairMesh("m")}, {{0, scale(NAN, 1, 1)}}}, {}), Error);
}

TEST(ShareMeshes, treatsOneMeshAsOneInstance) {
    const Scene scene = shareMeshes({{triangleMesh("one")}, {{0, kIdentityTransform}}}, {});
    EXPECT_EQ(scene.instances, (std::vector<SceneInstance>{{kIdentityAffine, 0, 0, 0}}));
}

TEST(ShareMeshes, leavesOutMeshesWhoseTrianglesWereAllDropped) {
    const Mesh flat{"flat", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}};
    const ImportedScene imported{{flat, pairMesh("pair")},
                                 {{0, kIdentityTransform},
                                  {1, kIdentityTransform},
                                  {0, kIdentityTransform},
                                  {1, translation(1, 0, 0)},
                                  {0, translation(1, 0, 0), {}, true}}};
    const Scene scene = shareMeshes(imported, {OnDegenerate::drop});
    EXPECT_EQ(scene.meshes, (std::vector<SceneMesh>{{0, 1, 0, 2}, {1, 2, 2, 2}}));
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].firstGeometry, 1u);
    EXPECT_EQ(scene.instances[1].firstGeometry, 3u);
    EXPECT_EQ(scene.geometries.size(), 3u);
    EXPECT_THROW(shareMeshes({{flat}, {{0, kIdentityTransform}}}, {OnDegenerate::drop}), Error);
}

// The limit is on what hits can number, not on what is stored.
TEST(ShareMeshes, refusesMoreThanTwoToTheThirtyOneTrianglesInAll) {
    Mesh mesh = triangleMesh("many");
    mesh.triangles.resize(1 << 16, {0, 1, 2});
    const auto placed = [&](size_t count) { return ImportedScene{{mesh}, std::vector<Instance>(count)}; };
    EXPECT_EQ(shareMeshes(placed((1 << 15) - 1), {}).primitiveCount(), (1u << 31) - (1u << 16));
    try {
        shareMeshes(placed(1 << 15), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

}  // namespace
}  // namespace bvhio
