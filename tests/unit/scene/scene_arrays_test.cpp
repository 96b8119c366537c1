// A scene that a program makes is checked before a builder or a writer takes it: one with an index out of
// range made builders read anywhere, one with a NaN got a tree of one node, and one without geometries became
// a file that no reader takes.
#include "scene/scene_arrays.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/test_scenes.h"
#include "scene/check_scene.h"

namespace bvhio {
namespace {

const std::vector<Vec3> kVertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
const std::vector<uint32_t> kIndices = {0, 1, 2, 1, 3, 2};

SceneArrays square() {
    SceneArrays arrays;
    arrays.vertices = kVertices.data();
    arrays.vertexCount = kVertices.size();
    arrays.indices = kIndices;
    return arrays;
}

void expectRefused(const Scene& scene, const std::string& word) {
    try {
        checkScene(scene);
        ADD_FAILURE() << word;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::invalid);
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(SceneFromArrays, isValidAndHasOneGeometryUnlessSomeAreGiven) {
    const Scene scene = sceneFromArrays(square());
    checkScene(scene);
    EXPECT_EQ(scene.geometries, (std::vector<Geometry>{{"", 0, 2}}));
    const SceneArrays::Part parts[] = {{"a", 1}, {"b", 1}};
    SceneArrays arrays = square();
    arrays.geometries = parts;
    EXPECT_EQ(sceneFromArrays(arrays).geometries, (std::vector<Geometry>{{"a", 0, 1}, {"b", 1, 1}}));
}

TEST(SceneFromArrays, numbersInstancesAsImportersDo) {
    const SceneArrays::Part parts[] = {{"a", 1}, {"b", 1}};
    const uint32_t meshes[] = {1, 1};
    const SceneArrays::Placed placed[] = {{1, kIdentityAffine}, {0, kIdentityAffine}, {1, kIdentityAffine}};
    SceneArrays arrays = square();
    arrays.geometries = parts;
    arrays.meshes = meshes;
    arrays.instances = placed;
    const Scene scene = sceneFromArrays(arrays);
    EXPECT_EQ(scene.meshes, (std::vector<SceneMesh>{{0, 1, 0, 1}, {1, 1, 1, 1}}));
    for (uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.instances[i].firstPrimitive, i);
        EXPECT_EQ(scene.instances[i].firstGeometry, i);
    }
}

TEST(CheckScene, takesEveryTestScene) {
    for (const test::TestScene& scene : test::testScenes())
        EXPECT_NO_THROW(checkScene(scene.make())) << scene.name;
}

TEST(CheckScene, namesWhatIsWrong) {
    const Scene good = sceneFromArrays(square());
    Scene scene = good;
    scene.geometries.clear();
    expectRefused(scene, "no geometries");
    scene = good;
    scene.triangles = {};
    expectRefused(scene, "no triangles");
    scene = good;
    scene.vertices = {};
    expectRefused(scene, "no vertices");
    scene = good;
    scene.geometries[0].triangleCount = 3;
    expectRefused(scene, "2 triangles, but its geometries have 3");
    scene = good;
    scene.geometries[0].firstTriangle = 1;
    expectRefused(scene, "geometry 0 start at triangle 1");
    scene = good;
    scene.sourcePrimitives = std::vector<uint32_t>{1};
    expectRefused(scene, "1 source primitives for 2 triangles");
    scene = good;
    scene.meshes = {{0, 1, 0, 2}};
    expectRefused(scene, "meshes, but no instances");
    scene.instances = {{kIdentityAffine, 0, 1, 0}};
    expectRefused(scene, "instance 0 whose primitive or geometry numbers do not follow");
    scene.instances = {{kIdentityAffine, 1, 0, 0}};
    expectRefused(scene, "mesh 1, but there are only 1");
    scene.instances = {{Affine{}, 0, 0, 0}};
    expectRefused(scene, "inverted");
    scene.instances = {{kIdentityAffine, 0, 0, 0}};
    scene.meshes = {{0, 1, 0, 1}};
    expectRefused(scene, "mesh 0 whose first geometry, first triangle or triangle count does not match");
    scene.meshes = {{0, 2, 0, 2}};
    expectRefused(scene, "its meshes have 2");
    scene = good;
    scene.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 1, 4}};
    expectRefused(scene, "triangle 1 has a vertex index beyond 3");
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        scene = good;
        scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, value, 0}, {1, 1, 0}};
        expectRefused(scene, "vertex 2 is not finite");
    }
    scene = good;
    scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, -0.0f, 0}, {0, 1, 0}, {1, 1, 0}};
    expectRefused(scene, "vertex 1 is -0");
}

}  // namespace
}  // namespace bvhio
