#include "scene/moved_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "common/test_scenes.h"
#include "core/error.h"

namespace bvhio {
namespace {

/// Two geometries of two and one triangles that share vertices.
Scene twoGeometries(float shift) {
    std::vector<Vec3> vertices{{shift, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    std::vector<TriangleIndices> triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    return {std::move(vertices), std::move(triangles), {{"square", 0, 2}, {"wing", 2, 1}}, {}};
}

std::string refusal(const Scene& old, const Scene& moved) {
    try {
        movedScene(old, moved);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::invalid);
        return error.what();
    }
    return "";
}

TEST(MovedScene, hasTheNewVerticesAndNames) {
    Scene moved = twoGeometries(-3);
    moved.geometries[1].name = "flap";
    const Scene scene = movedScene(twoGeometries(0), moved);
    EXPECT_EQ(scene.vertices[0].x, -3);
    EXPECT_EQ(scene.geometries, moved.geometries);
    EXPECT_TRUE(std::equal(scene.triangles.begin(), scene.triangles.end(), moved.triangles.begin()));
}

// An exporter may renumber vertices, so their numbers do not identify a mesh.
TEST(MovedScene, knowsVerticesByTheTrianglesThatTheyJoin) {
    Scene moved = twoGeometries(0);
    moved.vertices = std::vector<Vec3>{{2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}};
    moved.triangles = std::vector<TriangleIndices>{{4, 3, 2}, {4, 2, 1}, {3, 0, 2}};
    const Scene scene = movedScene(twoGeometries(0), moved);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(bounds(scene.triangle(i)), bounds(twoGeometries(0).triangle(i)));
}

TEST(MovedScene, findsDroppedAndReorderedTrianglesBySourceNumbers) {
    Scene old = twoGeometries(0);
    old.triangles = std::vector<TriangleIndices>{{0, 2, 3}, {1, 4, 2}};
    old.geometries = {{"square", 0, 1}, {"wing", 1, 1}};
    old.sourcePrimitives = std::vector<uint32_t>{1, 0};
    const Scene scene = movedScene(old, twoGeometries(-3));
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.triangles[0], (TriangleIndices{0, 2, 3}));
    EXPECT_EQ(scene.geometries, old.geometries);
    EXPECT_EQ(scene.sourcePrimitives[0], 1u);

    old.sourcePrimitives = std::vector<uint32_t>{2, 0};
    EXPECT_NE(refusal(old, twoGeometries(0)).find("geometry 0"), std::string::npos);
}

TEST(MovedScene, refusesAnotherMesh) {
    const Scene old = twoGeometries(0);
    Scene other = old;
    other.geometries = {{"square", 0, 3}};
    EXPECT_NE(refusal(old, other).find("1 geometries, but the tree has 2"), std::string::npos);

    other = old;
    other.geometries = {{"square", 0, 1}, {"wing", 1, 2}};
    EXPECT_NE(refusal(old, other).find("geometry 0 has 1 triangles, but the tree has 2"), std::string::npos);

    other = old;  // a corner elsewhere: two vertices of `old` would be one
    other.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 2, 1}, {1, 4, 2}};
    EXPECT_NE(refusal(old, other).find("triangle 1 of geometry 0"), std::string::npos);

    other = old;  // torn apart: one vertex of `old` would be two
    other.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 2, 3}, {3, 4, 2}};
    EXPECT_NE(refusal(old, other).find("triangle 0 of geometry 1"), std::string::npos);
}

}  // namespace
}  // namespace bvhio
