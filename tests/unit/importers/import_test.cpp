#include "importers/import.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "importers/draco_mesh.h"
#include "unit/importers/import_helpers.h"

namespace bvhio {
namespace {

const std::string kObj = "# three corners\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Import, goesByContentBeforeName) {
    const std::string stl =
        "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
        "endfacet\nendsolid\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(sceneFrom(stl, "x.ply").triangles.size(), 1u);
    EXPECT_EQ(sceneFrom(ply, "x.stl").triangles.size(), 1u);
    EXPECT_EQ(sceneFrom(ply, "standard input").triangles.size(), 1u);
    EXPECT_EQ(sceneFrom(kObj, "standard input").triangles.size(), 1u);
    EXPECT_EQ(sceneFrom("\xef\xbb\xbf" + kObj, "X.OBJ").triangles.size(), 1u);
}

TEST(Import, readsDracoFiles) {
    const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto bytes = encodeDraco(vertices, std::vector<TriangleIndices>{{0, 1, 2}}, 10);
    const Scene scene = flatten(importBytes(bytes, "x.drc", "."), {});
    EXPECT_EQ(scene.triangle(0).v1, (Vec3{1, 0, 0}));
    refusal("DRACO and then nothing", "x.drc");
}

TEST(Import, saysWhatAFileIsNot) {
    EXPECT_NE(refusal("", "x.obj").find("empty"), std::string::npos);
    EXPECT_NE(refusal("hello", "x.ply").find("is not that of a .ply file"), std::string::npos);
    EXPECT_NE(refusal("hello", "x.txt", ErrorKind::unsupported).find("x.txt"), std::string::npos);
    EXPECT_NE(refusal(std::string("\xfe\xff\0v", 4), "x.obj", ErrorKind::unsupported).find("UTF-16"),
              std::string::npos);
}

TEST(Import, knowsTheKindOfAFile) {
    EXPECT_EQ(sceneKind(asBytes("glTF and more"), "x.bvhx"), "GLB");
    EXPECT_EQ(sceneKind(asBytes("{}"), "x.gltf"), "glTF");
    EXPECT_EQ(sceneKind(asBytes(kObj), "standard input"), "OBJ");
    EXPECT_EQ(sceneKind(asBytes("ply\nformat"), "x"), "PLY");
    EXPECT_EQ(sceneKind(asBytes("solid"), "x"), "STL");
    EXPECT_EQ(sceneKind(asBytes("DRACO"), "x"), "Draco");
    for (const char* other : {"", "hello"}) EXPECT_EQ(sceneKind(asBytes(other), "x.glb"), "") << other;
    const std::string container =
        "\x9c"
        "BVHX \r\n\x1a\n" +
        std::string("\0\xfe", 2);
    EXPECT_EQ(sceneKind(asBytes(container), "x.obj"), "");
    EXPECT_NE(refusal(container, "x.obj", ErrorKind::unsupported).find("x.obj: is a .bvhx already"),
              std::string::npos);
}

// Fails if messages name a file without the folder that was given.
TEST(Import, namesTheFileByItsWholePath) {
    const auto path =
        std::filesystem::temp_directory_path() / ("bvhio_path_test_" + std::to_string(::getpid()) + ".obj");
    std::ofstream(path) << "v 0 0\n";
    try {
        importFile(path);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": ")) << error.what();
    }
    std::filesystem::remove(path);
}

TEST(Import, readsFiles) {
    const auto path =
        std::filesystem::temp_directory_path() / ("bvhio_import_test_" + std::to_string(::getpid()) + ".obj");
    std::ofstream(path) << kObj;
    const ImportedScene scene = importFile(path);
    std::filesystem::remove(path);
    EXPECT_EQ(scene.meshes.at(0).name, "");  // the same bytes must come from a file by any name, or a pipe
    EXPECT_EQ(scene.instances.size(), 1u);
    for (const auto& missing : {path, std::filesystem::temp_directory_path()}) {
        try {
            importFile(missing);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::io);
        }
    }
}

}  // namespace
}  // namespace bvhio
