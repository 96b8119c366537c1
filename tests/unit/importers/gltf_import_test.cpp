#include <meshoptimizer.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "importers/draco_mesh.h"
#include "unit/importers/import_helpers.h"

namespace bvhio {
namespace {

/// A GLB from its JSON, in which BYTES stands for the size of the binary chunk.
std::string glb(std::string json, std::string binary) {
    if (const size_t at = json.find("BYTES"); at != std::string::npos)
        json.replace(at, 5, std::to_string(binary.size()));
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    Binary file;
    file.text = "glTF";
    file.addAll<uint32_t>({2, uint32_t(28 + json.size() + binary.size()), uint32_t(json.size()), 0x4E4F534A});
    file.text += json;
    file.addAll<uint32_t>({uint32_t(binary.size()), 0x004E4942});
    return file.text + binary;
}

const std::string kHead = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":BYTES}],)";
const std::string kMeshAndScene =
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[0]}],)";
const std::string kOneNode = R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],)";

std::string floats(std::initializer_list<float> values) {
    return Binary().addAll<float>(values).text;
}
const std::string kCorners = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0});

/// A file with kCorners as accessor 0 and five bytes of indices, 0 1 2 3 4, as accessor 1.
std::string fiveCorners(const std::string& rest) {
    return glb(
        kHead + R"("bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":5}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},
                     {"bufferView":1,"componentType":5121,"count":5,"type":"SCALAR"}],)" +
            rest + "}",
        kCorners + std::string("\0\1\2\3\4", 5));
}

std::string withPrimitive(const std::string& primitive) {
    return fiveCorners(kOneNode + R"("meshes":[{"name":"thing","primitives":[)" + primitive + "]}]");
}

using Triangles = std::vector<TriangleIndices>;
Triangles trianglesOf(const std::string& file) {
    return importText(file, "x.glb").meshes.at(0).triangles;
}

TEST(Gltf, connectsEveryMode) {
    const auto mode = [](int number, bool indexed) {
        return withPrimitive(R"({"attributes":{"POSITION":0},"mode":)" + std::to_string(number) +
                             (indexed ? R"(,"indices":1})" : "}"));
    };
    for (const bool indexed : {false, true}) {
        for (const int lineOrPoint : {0, 1, 2, 3})
            EXPECT_TRUE(trianglesOf(mode(lineOrPoint, indexed)).empty());
        EXPECT_EQ(trianglesOf(mode(4, indexed)), (Triangles{{0, 1, 2}}));
        EXPECT_EQ(trianglesOf(mode(5, indexed)), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
        EXPECT_EQ(trianglesOf(mode(6, indexed)), (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
    }
    EXPECT_NE(refusal(mode(7, false), "x.glb").find("mode"), std::string::npos);
}

TEST(Gltf, countsPointsAndLinesAsGeometries) {
    const Scene scene = sceneFrom(
        withPrimitive(R"({"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0}})"), "x.glb");
    EXPECT_EQ(scene.geometries, (std::vector<Geometry>{{"thing.0", 0, 0}, {"thing.1", 0, 1}}));
}

TEST(Gltf, placesNodesDepthFirstInTheDefaultScene) {
    const std::string file = fiveCorners(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "scene":1,"scenes":[{"nodes":[1]},{"nodes":[0,3]}],
        "nodes":[{"children":[2,1],"scale":[2,-2,2],"translation":[10,0,0]},
                 {"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757]},
                 {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,3,1]},{"mesh":0}])");
    const Scene scene = sceneFrom(file, "x.glb");
    ASSERT_EQ(scene.triangles.size(), 3u);
    EXPECT_EQ(scene.triangle(0).v1, (Vec3{12, 0, 6}));   // node 2 in node 0
    EXPECT_EQ(scene.triangle(0).v2, (Vec3{10, -2, 6}));  // its negative scale
    EXPECT_NEAR(scene.triangle(1).v1.x, 10, 1e-6);       // node 1 in node 0: a quarter turn, then mirrored
    EXPECT_NEAR(scene.triangle(1).v1.y, -2, 1e-6);
    EXPECT_EQ(scene.triangle(2).v1, (Vec3{1, 0, 0}));  // node 3
}

TEST(Gltf, takesEveryRootWhenThereIsNoScene) {
    const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)";
    EXPECT_EQ(sceneFrom(fiveCorners(mesh + R"("nodes":[{"mesh":0},{"children":[0]},{"mesh":0}])"), "x.glb")
                  .triangles.size(),
              2u);
    EXPECT_NE(refusal(fiveCorners(mesh + R"("nodes":[{"mesh":0,"children":[0]}])"), "x.glb").find("cycle"),
              std::string::npos);
}

TEST(Gltf, sharesDataThatSeveralMeshesUse) {
    const ImportedScene scene =
        importText(fiveCorners(R"("nodes":[{"mesh":0},{"mesh":1}],"scenes":[{"nodes":[0,1]}],
            "meshes":[{"name":"red","primitives":[{"attributes":{"POSITION":0},"material":0}]},
                      {"name":"blue","primitives":[{"attributes":{"POSITION":0},"material":1}]}])"),
                   "x.glb");
    EXPECT_EQ(scene.meshes.size(), 1u);
    const Scene flat = flatten(scene, {});
    EXPECT_EQ(flat.geometries, (std::vector<Geometry>{{"red", 0, 1}, {"blue", 1, 1}}));
}

/// A file with one triangle list whose accessors, views and binary are given.
std::string oneMesh(const std::string& views, const std::string& accessors, const std::string& binary,
                    const std::string& primitive = R"({"attributes":{"POSITION":0}})",
                    const std::string& more = "") {
    return glb(kHead + more + kOneNode + R"("meshes":[{"name":"m","primitives":[)" + primitive +
                   R"(]}],"bufferViews":[)" + views + R"(],"accessors":[)" + accessors + "]}",
               binary);
}

TEST(Gltf, readsInterleavedAndSparseAccessors) {
    const std::string interleaved = floats({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9});
    const std::string file = oneMesh(
        R"({"buffer":0,"byteLength":48,"byteStride":16},{"buffer":0,"byteOffset":48,"byteLength":2},{"buffer":0,"byteOffset":52,"byteLength":24})",
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
            "sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}})",
        interleaved + std::string("\0\2\0\0", 4) + floats({5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(importText(file, "x.glb").meshes.at(0).vertices,
              (std::vector<Vec3>{{5, 6, 7}, {1, 0, 0}, {8, 9, 10}}));
}

TEST(Gltf, startsSparseAccessorsWithoutBytesAtZero) {
    const std::string file =
        oneMesh(R"({"buffer":0,"byteLength":4},{"buffer":0,"byteOffset":4,"byteLength":12})",
                R"({"componentType":5126,"count":3,"type":"VEC3",
            "sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":1}}})",
                Binary().add(uint32_t(1)).text + floats({5, 6, 7}));
    EXPECT_EQ(importText(file, "x.glb").meshes.at(0).vertices,
              (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}}));
}

TEST(Gltf, dividesNormalisedIntegers) {
    const std::string file =
        oneMesh(R"({"buffer":0,"byteLength":24,"byteStride":8})",
                R"({"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"})",
                Binary().addAll<int16_t>({32767, -32767, -32768, 0, 0, 0, 1, 0, 0, 0, 0, 0}).text,
                R"({"attributes":{"POSITION":0}})", R"("extensionsRequired":["KHR_mesh_quantization"],)");
    const std::vector<Vec3> vertices = importText(file, "x.glb").meshes.at(0).vertices;
    EXPECT_EQ(vertices[0], (Vec3{1, -1, -1}));
    EXPECT_EQ(vertices[1], (Vec3{0, 0, 1 / 32767.0f}));
}

TEST(Gltf, decodesDraco) {
    const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto bytes = encodeDraco(vertices, Triangles{{2, 1, 0}}, 8);
    const std::string binary(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string file = oneMesh(
        R"({"buffer":0,"byteLength":)" + std::to_string(binary.size()) + "}",
        R"({"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5123,"count":3,"type":"SCALAR"})",
        binary,
        R"({"attributes":{"POSITION":0},"indices":1,
                    "extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}})",
        R"("extensionsRequired":["KHR_draco_mesh_compression","KHR_materials_unlit","KHR_texture_transform"],)");
    const Mesh mesh = importText(file, "x.glb").meshes.at(0);
    EXPECT_EQ(mesh.vertices, vertices);
    EXPECT_EQ(mesh.triangles, (Triangles{{2, 1, 0}}));
    damageEverywhere(file, "x.glb", 7);
}

// Fails if a small file can have the same Draco data decoded and kept any number of times, by naming it from
// many primitives.
TEST(Gltf, boundsHowOftenDracoDataIsDecoded) {
    const Triangles triangles(20'000, {0, 1, 2});
    const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto bytes = encodeDraco(vertices, triangles, 8);
    const std::string binary(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto file = [&](int primitives) {
        std::string accessors, list;
        for (int i = 0; i < primitives; ++i) {  // an accessor each, so that no two are the same
            const std::string comma = i > 0 ? "," : "";
            accessors += comma + R"({"componentType":5126,"count":3,"type":"VEC3"})";
            list +=
                comma + R"({"attributes":{"POSITION":)" + std::to_string(i) +
                R"(},"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}})";
        }
        return oneMesh(R"({"buffer":0,"byteLength":)" + std::to_string(binary.size()) + "}", accessors,
                       binary, list);
    };
    EXPECT_EQ(importText(file(3), "x.glb").meshes.size(), 3u);
    EXPECT_THROW(importText(file(200), "x.glb"), Error);
}

std::string meshoptFile(const std::string& mode = "ATTRIBUTES", const std::string& count = "3") {
    const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::string binary(meshopt_encodeVertexBufferBound(3, 12), '\0');
    binary.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(binary.data()), binary.size(),
                                             vertices, 3, 12));
    return glb(
        R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":BYTES},
                   {"byteLength":36,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],)" +
            kOneNode +
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
                   "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
                   "bufferViews":[{"buffer":1,"byteLength":36,"byteStride":12,"extensions":{"EXT_meshopt_compression":
                   {"buffer":0,"byteLength":)" +
            std::to_string(binary.size()) + R"(,"byteStride":12,"count":)" + count + R"(,"mode":")" + mode +
            R"("}}}]})",
        binary);
}

TEST(Gltf, decompressesMeshopt) {
    EXPECT_EQ(importText(meshoptFile(), "x.glb").meshes.at(0).vertices,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_NE(refusal(meshoptFile("TRIANGLES"), "x.glb").find("not allowed"), std::string::npos);
    EXPECT_NE(refusal(meshoptFile("ATTRIBUTES", "2000000"), "x.glb").find("more elements"),
              std::string::npos);
    EXPECT_NE(refusal(meshoptFile("ATTRIBUTES", "400"), "x.glb").find("damaged"), std::string::npos);
}

// Fails if something that is not read, or not applied, is not counted, or counted as often as it is placed.
TEST(Gltf, countsWhatIsLeftOut) {
    const ImportedScene scene = importText(
        fiveCorners(R"("nodes":[{"mesh":0,"skin":0},{"mesh":0,"skin":0,"camera":0},{"mesh":1},{"camera":"x"},
                {"mesh":4,"skin":0}],"scenes":[{"nodes":[0,1,2,3]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}]},
                                     {"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}]}]},
                      {"primitives":[{"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"mode":1},
                                     {"attributes":{"POSITION":0},"mode":3},{"attributes":{}},
                                     {"attributes":{"POSITION":0},"targets":7}]},
                      {"primitives":[]},{"primitives":[]},{"primitives":[]}])"),
        "x.glb");
    EXPECT_EQ(scene.leftOut, (LeftOut{.points = 1,
                                      .lines = 2,
                                      .withoutPositions = 1,
                                      .unusedMeshes = 3,
                                      .skins = 2,
                                      .morphTargets = 2,
                                      .cameras = 1}));
    EXPECT_EQ(importText(withPrimitive(R"({"attributes":{"POSITION":0}})"), "x.glb").leftOut, LeftOut{});
}

// Files of version 1.0 need not say so, and have objects where 2.0 has lists.
TEST(Gltf, namesVersionOne) {
    for (const char* json : {R"({"asset":{"version":"1.0"}})", R"({"asset":{"profile":{}},"meshes":{}})",
                             R"({"nodes":{"a":{}}})"})
        EXPECT_NE(refusal(json, "x.gltf", ErrorKind::unsupported).find("the file is glTF 1.0: convert"),
                  std::string::npos)
            << json;
    const std::string old = "glTF" + Binary().addAll<uint32_t>({1, 24, 4, 0}).text + "{}  ";
    EXPECT_NE(refusal(old, "x.glb", ErrorKind::unsupported).find("the file is glTF 1.0: convert"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"meshes":[]})", "x.gltf").find("'version'"), std::string::npos);
}

TEST(Gltf, placesInstancesOfOneNode) {
    const auto file = [](int scales) {
        return glb(
            kHead +
                R"("bufferViews":[{"buffer":0,"byteLength":60}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                         {"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"},
                         {"bufferView":0,"byteOffset":12,"componentType":5126,"count":)" +
                std::to_string(scales) + R"(,"type":"VEC3"}],
            "scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,0,1],
            "extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"SCALE":2,"_ID":0}}}}]})",
            floats({0, 0, 0, 3, 2, 2, 0, 1, 0, 1, 1, 0, 2, 0, 0}));
    };
    const ImportedScene scene = importText(file(2), "x.glb");
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].transform, (Transform{3, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 1}));
    EXPECT_EQ(scene.instances[1].transform, (Transform{0, 0, 0, 3, 0, 1, 0, 2, 0, 0, 0, 3}));
    EXPECT_NE(refusal(file(3), "x.glb").find("different lengths"), std::string::npos);
}

// Accessors: 0 = five VEC3, 1 = five indices, 2 = two VEC3, 3 = two quaternions of normalised bytes.
TEST(Gltf, readsAnyAttributesOfInstancesOrSaysWhatIsWrong) {
    const auto file = [](const std::string& extension) {
        return glb(
            kHead +
                R"("bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":8}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                         {"bufferView":1,"componentType":5121,"count":2,"type":"SCALAR"},
                         {"bufferView":0,"byteOffset":12,"componentType":5126,"count":2,"type":"VEC3"},
                         {"bufferView":1,"componentType":5120,"normalized":true,"count":2,"type":"VEC4"},
                         {"componentType":5121,"count":4503599627370496,"type":"SCALAR"}],)" +
                kMeshAndScene + R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)" + extension +
                "}}]}",
            kCorners + std::string("\0\0\0\x7F\0\0\x7F\0", 8));
    };
    const ImportedScene turned = importText(file(R"({"attributes":{"ROTATION":3}})"), "x.glb");
    ASSERT_EQ(turned.instances.size(), 2u);
    EXPECT_EQ(turned.instances[0].transform, kIdentityTransform);
    EXPECT_EQ(turned.instances[1].transform, (Transform{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0}));
    EXPECT_EQ(importText(file(R"({"attributes":{"_ID":1}})"), "x.glb").instances.size(), 2u);

    for (const auto& [extension, message] :
         {std::pair<std::string, std::string>{R"({})", "has no attributes"},
          {R"({"attributes":{}})", "has no attributes"},
          {R"({"attributes":[2]})", "has no attributes"},
          {R"({"attributes":{"TRANSLATION":"2"}})", "has a TRANSLATION that is not an accessor"},
          {R"({"attributes":{"TRANSLATION":9}})", "the file has no such accessor"},
          {R"({"attributes":{"TRANSLATION":-1}})", "the file has no such accessor"},
          {R"({"attributes":{"TRANSLATION":3}})", "its type is not allowed"},
          {R"({"attributes":{"ROTATION":2}})", "its type is not allowed"},
          {R"({"attributes":{"TRANSLATION":2,"SCALE":0}})", "different lengths"}})
        EXPECT_NE(refusal(file(extension), "x.glb").find(message), std::string::npos) << extension;
    EXPECT_NE(refusal(file(R"({"attributes":{"_ID":4}})"), "x.glb", ErrorKind::resources).find("far more"),
              std::string::npos);
}

TEST(Gltf, readsBuffersFromDataAndFilesBesideIt) {
    const auto directory =
        std::filesystem::temp_directory_path() / ("bvhio_gltf_test_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory);
    std::ofstream(directory / "a b.bin", std::ios::binary) << kCorners;
    const auto text = [](const std::string& uri) {
        return R"( {"asset":{"version":"2.0"},"images":[{"uri":"missing.png"},{"bufferView":99,"mimeType":"image/png"}],
            "textures":[{"source":7}],"buffers":[{"byteLength":36,"uri":")" +
               uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" +
               kOneNode + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
    };
    const auto read = [&](const std::string& uri) {
        return importBytes(asBytes(text(uri)), "x.gltf", directory).meshes.at(0).vertices.at(1);
    };
    EXPECT_EQ(read("a%20b.bin"), (Vec3{1, 0, 0}));
    EXPECT_EQ(read("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"),
              (Vec3{1, 0, 0}));
    for (const char* uri :
         {"../x.bin", "/etc/passwd", "file:///etc/passwd", "http://example.org/x.bin", "a\\u0000b", "%00",
          "data:application/octet-stream;base64,AAAA", "data:what", ""}) {
        try {
            read(uri);
            ADD_FAILURE() << uri;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::invalid) << uri << ": " << error.what();
        }
    }
    try {
        read("missing.bin");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_NE(std::string(error.what()).find("x.gltf: buffer 0: "), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("missing.bin"), std::string::npos);
    }
    std::filesystem::remove_all(directory);
}

TEST(Gltf, refusesNodesWithTwoParentsAndCycles) {
    const std::string mesh =
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[0]}],)";
    for (const char* nodes :
         {R"([{"children":[1]},{"children":[0],"mesh":0}])",
          R"([{"children":[1,2]},{"children":[2]},{"mesh":0}])", R"([{"children":[0],"mesh":0}])"})
        EXPECT_NE(refusal(fiveCorners(mesh + R"("nodes":)" + nodes), "x.glb").find("two parents"),
                  std::string::npos);
    EXPECT_NE(refusal(fiveCorners(mesh + R"("nodes":[{"children":[7]}])"), "x.glb").find("no node 7"),
              std::string::npos);
    EXPECT_NE(refusal(fiveCorners(mesh + R"("nodes":[{"mesh":7}])"), "x.glb").find("no mesh 7"),
              std::string::npos);

    std::string chain = "[";  // deep, but a tree
    for (int i = 1; i < 20000; ++i) chain += R"({"children":[)" + std::to_string(i) + "]},";
    EXPECT_EQ(
        sceneFrom(fiveCorners(mesh + R"("nodes":)" + chain + R"({"mesh":0}])"), "x.glb").triangles.size(),
        1u);
}

TEST(Gltf, refusesExtensionsItDoesNotKnowOnlyWhenRequired) {
    const std::string rest = kOneNode + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    EXPECT_EQ(sceneFrom(fiveCorners(rest + R"(,"extensionsUsed":["ACME_new"])"), "x.glb").triangles.size(),
              1u);
    const std::string message =
        refusal(fiveCorners(rest + R"(,"extensionsRequired":["ACME_new"])"), "x.glb", ErrorKind::unsupported);
    EXPECT_NE(message.find("ACME_new"), std::string::npos);
}

TEST(Gltf, refusesWhatReachesOutOfBounds) {
    const auto accessor = [](const std::string& members) {
        return R"({"componentType":5126,"type":"VEC3",)" + members + "}";
    };
    const std::string view = R"({"buffer":0,"byteLength":36})";
    const auto message = [&](const std::string& views, const std::string& members,
                             ErrorKind kind = ErrorKind::invalid) {
        return refusal(oneMesh(views, accessor(members), kCorners), "x.glb", kind);
    };
    EXPECT_NE(message(view, R"("bufferView":0,"count":4)").find("accessor 0"), std::string::npos);
    EXPECT_NE(
        message(view, R"("bufferView":0,"count":4503599627370496)", ErrorKind::resources).find("far more"),
        std::string::npos);
    EXPECT_NE(message(view, R"("bufferView":0,"byteOffset":1,"count":3)").find("accessor 0"),
              std::string::npos);
    EXPECT_NE(message(view, R"("bufferView":1,"count":3)").find("buffer view 1"), std::string::npos);
    EXPECT_NE(message(R"({"buffer":0,"byteOffset":30,"byteLength":36})", R"("bufferView":0,"count":3)")
                  .find("beyond buffer 0"),
              std::string::npos);
    EXPECT_NE(message(R"({"buffer":3,"byteLength":36})", R"("bufferView":0,"count":3)").find("buffer 3"),
              std::string::npos);
    EXPECT_NE(message(view, R"("count":100000000000)", ErrorKind::resources).find("far more"),
              std::string::npos);
    EXPECT_NE(message(view, R"("bufferView":0,"count":-3)").find("'count' is not a size"), std::string::npos);
    EXPECT_NE(
        refusal(withPrimitive(R"({"attributes":{"POSITION":0},"indices":0})"), "x.glb").find("unsigned"),
        std::string::npos);
    EXPECT_NE(
        refusal(withPrimitive(R"({"attributes":{"POSITION":1}})"), "x.glb").find("accessor 1: its type"),
        std::string::npos);
    EXPECT_NE(refusal(withPrimitive(R"({"attributes":{"POSITION":9}})"), "x.glb").find("accessor 9"),
              std::string::npos);
    EXPECT_NE(refusal(withPrimitive(R"({"attributes":[1]})"), "x.glb").find("mesh 0"), std::string::npos);
    EXPECT_NE(refusal(R"({"asset":{"version":"2.0"},"nodes":{}})", "x.gltf").find("'nodes' is not a list"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"asset":{"version":"1.0"}})", "x.gltf", ErrorKind::unsupported).find("glTF 1.0"),
              std::string::npos);
    EXPECT_NE(refusal(std::string(100000, '['), "x.gltf").find("is not that of a .gltf file"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"a":)" + std::string(100000, '['), "x.gltf").find("levels deep"),
              std::string::npos);
    for (const char* odd : {R"({"asset":{"version":"2.0"},"a":1e999})", R"({"asset":["2.0"]})",
                            R"({"asset":{"version":["2.0"]}})", R"({"asset":"2.0"})",
                            R"({"asset":{"version":"2.0"},"nodes":[1e999]})"})
        refusal(odd, "x.gltf");
    const std::string whole = withPrimitive(R"({"attributes":{"POSITION":0}})");
    EXPECT_NE(refusal(whole.substr(0, whole.size() - 1), "x.glb").find("cut short"), std::string::npos);
}

TEST(Gltf, readsFewOfManySharedVertices) {
    std::string binary = floats({});
    for (int i = 0; i < 100; ++i) binary += floats({float(i), 0, 1});
    binary += Binary().addAll<uint32_t>({90, 7, 50, 7, 8, 90}).text;
    const std::string file =
        oneMesh(R"({"buffer":0,"byteLength":1200},{"buffer":0,"byteOffset":1200,"byteLength":24})",
                R"({"bufferView":0,"componentType":5126,"count":100,"type":"VEC3"},
                                        {"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"})",
                binary, R"({"attributes":{"POSITION":0},"indices":1})");
    const Mesh mesh = importText(file, "x.glb").meshes.at(0);
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{7, 0, 1}, {8, 0, 1}, {50, 0, 1}, {90, 0, 1}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{3, 0, 2}, {0, 1, 3}}));
}

TEST(Gltf, survivesCutsAndFlippedBits) {
    damageEverywhere(withPrimitive(R"({"attributes":{"POSITION":0},"indices":1,"mode":5})"), "x.glb", 7);
    damageEverywhere(meshoptFile(), "x.glb", 7);
}

}  // namespace
}  // namespace bvhio
