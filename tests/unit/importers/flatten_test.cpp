#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "unit/importers/import_helpers.h"

namespace bvhio {
namespace {

std::string flattenRefusal(const ImportedScene& scene, const ImportOptions& options = {}) {
    try {
        flatten(scene, options);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::invalid);
        return error.what();
    }
    ADD_FAILURE() << "not refused";
    return "";
}

TEST(Flatten, placesInstancesInOrderWithIdsOfTheSource) {
    Mesh points{"points", {{1, 1, 1}}, {}};
    Mesh pair{"pair", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    const ImportedScene imported{{triangleMesh("one"), points, pair},
                                 {{2, translation(0, 0, 5)},
                                  {1, kIdentityTransform},
                                  {0, translation(2, 0, 0)},
                                  {2, translation(0, 0, -5)}}};
    const Scene scene = flatten(imported, {});
    EXPECT_EQ(scene.geometries,
              (std::vector<Geometry>{{"pair", 0, 2}, {"points", 2, 0}, {"one", 2, 1}, {"pair", 3, 2}}));
    EXPECT_EQ(scene.triangle(1).v1, (Vec3{1, 1, 5}));
    EXPECT_EQ(scene.triangle(2).v1, (Vec3{3, 0, 0}));
    EXPECT_EQ(scene.triangle(4).v0, (Vec3{1, 0, -5}));
    EXPECT_EQ(scene.primitiveId(2).geometry, 2u);
    EXPECT_EQ(scene.primitiveId(4).geometry, 3u);
    EXPECT_EQ(scene.primitiveId(4).primitive, 1u);
}

TEST(Flatten, movesOneMeshThatStandsWhereItIs) {
    ImportedScene imported{{triangleMesh("one")}, {{0, kIdentityTransform}}};
    const Vec3* vertices = imported.meshes[0].vertices.data();
    const Scene scene = flatten(std::move(imported), {});
    EXPECT_EQ(scene.vertices.data(), vertices);
}

TEST(Flatten, makesMinusZeroPlusZero) {
    for (const Transform& transform :
         {kIdentityTransform, translation(1, 0, 0), Transform{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0}}) {
        Mesh mesh = triangleMesh("zeros");
        mesh.vertices[0] = {-0.0f, -0.0f, 0.0f};
        const Scene scene = flatten({{mesh}, {{0, transform}}}, {});
        for (const Vec3& v : scene.vertices)
            for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(v[axis] == 0 && std::signbit(v[axis]));
    }
}

TEST(Flatten, roundsTransformedVerticesOnce) {
    Mesh mesh = triangleMesh("far");
    mesh.vertices[1] = {16777216, 0, 0};
    const Scene scene = flatten({{mesh}, {{0, Transform{1, 0, 0, -16777215, 0, 1, 0, 0, 0, 0, 1, 0}}}}, {});
    EXPECT_EQ(scene.vertices[1].x, 1.0f);
}

TEST(Flatten, refusesWhatIsNotFiniteOnlyWhereATriangleUsesIt) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Mesh mesh = triangleMesh("scan");
    mesh.vertices.insert(mesh.vertices.begin(), {nan, 0, 0});
    mesh.triangles = {{1, 2, 3}};
    const Scene scene = flatten({{mesh}, {{0, kIdentityTransform}}}, {});
    EXPECT_EQ(scene.vertices.size(), 3u);
    EXPECT_EQ(scene.triangle(0).v1, (Vec3{1, 0, 0}));
    mesh.triangles[0].v2 = 0;
    EXPECT_EQ(flattenRefusal({{mesh}, {{0, kIdentityTransform}}}),
              "mesh 0 'scan': vertex 0 is not finite (NaN or infinity)");
}

TEST(Flatten, refusesBadIndicesOverflowAndEmptiness) {
    Mesh mesh = triangleMesh("m");
    EXPECT_EQ(flattenRefusal({}), "the scene has no triangles");
    EXPECT_EQ(flattenRefusal({{mesh}, {}}), "the scene has no triangles");
    EXPECT_EQ(
        flattenRefusal({{triangleMesh("a"), mesh},
                        {{0, kIdentityTransform}, {1, Transform{1, 0, 0, 0, 0, 1e39, 0, 0, 0, 0, 1, 0}}}}),
        "mesh 1 'm': vertex 2 is not finite where instance 1 places it");
    mesh.triangles.push_back({0, 3, 1});
    EXPECT_EQ(flattenRefusal({{mesh}, {{0, kIdentityTransform}}}),
              "mesh 0 'm': triangle 1 uses vertex 3, but the mesh has only 3 vertices");
}

TEST(Flatten, refusesMoreThanTwoToTheThirtyOneTriangles) {
    Mesh mesh = triangleMesh("many");
    mesh.triangles.resize(1 << 16, {0, 1, 2});
    const ImportedScene imported{{mesh}, std::vector<Instance>(1 << 15)};
    try {
        flatten(imported, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

TEST(Flatten, treatsDegenerateTrianglesAsAsked) {
    // Two equal corners, three on a line, and a sliver so thin that its area in float would be 0.
    Mesh mesh{"bad",
              {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {1, 1, 1.0000001f}, {5, 0, 0}},
              {{0, 1, 1}, {0, 1, 4}, {0, 1, 2}, {0, 2, 3}}};
    Mesh tiny{"tiny", {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}}, {{0, 1, 2}}};
    const ImportedScene imported{{mesh, tiny},
                                 {{0, kIdentityTransform}, {1, kIdentityTransform}, {0, kIdentityTransform}}};
    EXPECT_EQ(flatten(imported, {OnDegenerate::keep}).triangles.size(), 9u);
    EXPECT_TRUE(flatten(imported, {OnDegenerate::keep}).sourcePrimitives.empty());

    const Scene dropped = flatten(imported, {OnDegenerate::drop});
    ASSERT_EQ(dropped.triangles.size(), 5u);
    EXPECT_EQ(dropped.geometries, (std::vector<Geometry>{{"bad", 0, 2}, {"tiny", 2, 1}, {"bad", 3, 2}}));
    EXPECT_EQ(std::vector<uint32_t>(dropped.sourcePrimitives.begin(), dropped.sourcePrimitives.end()),
              (std::vector<uint32_t>{1, 3, 0, 1, 3}));
    EXPECT_EQ(dropped.primitiveId(4).geometry, 2u);
    EXPECT_EQ(dropped.primitiveId(4).primitive, 3u);

    EXPECT_NE(flattenRefusal(imported, {OnDegenerate::error})
                  .find("4 triangles of zero area; the first is triangle 0 of geometry 0 'bad'"),
              std::string::npos);
    EXPECT_NE(flattenRefusal({{{"flat", {{0, 0, 0}}, {{0, 0, 0}}}}, {{0, kIdentityTransform}}},
                             {OnDegenerate::drop})
                  .find("zero area"),
              std::string::npos);
}

TEST(Flatten, givesTheSameSceneForAnyThreadCount) {
    Mesh mesh{"large", {}, {}};
    for (uint32_t i = 0; i < 100000; ++i) {
        mesh.vertices.push_back({float(i % 317), float(i % 1001), float(i / 7)});
        if (i >= 2 && i % 3) mesh.triangles.push_back({i - 2, i - 1, i});
    }
    const ImportedScene imported{
        {mesh, triangleMesh("b")},
        {{0, translation(1, 2, 3)}, {1, kIdentityTransform}, {0, translation(-1, 0, 0.5)}}};
    const auto run = [&](size_t threads) {
        const ThreadLimit limit(threads);
        return flatten(imported, {OnDegenerate::drop});
    };
    const Scene one = run(1), two = run(2);
    EXPECT_TRUE(
        std::equal(one.vertices.begin(), one.vertices.end(), two.vertices.begin(), two.vertices.end()));
    EXPECT_TRUE(
        std::equal(one.triangles.begin(), one.triangles.end(), two.triangles.begin(), two.triangles.end()));
    EXPECT_TRUE(std::equal(one.sourcePrimitives.begin(), one.sourcePrimitives.end(),
                           two.sourcePrimitives.begin(), two.sourcePrimitives.end()));
}

}  // namespace
}  // namespace bvhio
