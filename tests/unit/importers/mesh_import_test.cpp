#include "importers/mesh_import.h"

#include "unit/importers/import_helpers.h"

namespace bvhio {
namespace {

Mesh parseObj(std::span<const std::byte> bytes, const std::string& name) {
    LeftOut leftOut;
    return readObj(bytes, name, leftOut);
}
Mesh parsePly(std::span<const std::byte> bytes, const std::string& name) {
    LeftOut leftOut;
    return readPly(bytes, name, leftOut);
}

using Triangles = std::vector<TriangleIndices>;

TEST(Obj, fansPolygonsAndCountsBackFromNegativeIndices) {
    const Mesh mesh = parseObj(
        asBytes("# a comment\r\nmtllib none.mtl\no first\nv 0 0 0 1\nv +1 0 0\nv 1 1e0 0\nv 0 1 0\n"
                "usemtl b\nf 1/1 2//3 3/4/5 4\no second\nv 0 0 5\nusemtl a\nf -1 -2 \\\n -3\nl 1 2\np 1\n"
                "f 1 2\n"),
        "x.obj");
    EXPECT_EQ(mesh.vertices.size(), 5u);
    EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 3, 2}}));
}

TEST(Obj, roundsNumbersOnceAndKeepsTinyOnes) {
    const Mesh mesh = parseObj(asBytes("v 0.1 1e-45 -1e-60\nv 16777217 1e30 3.4028235e38\n"), "x.obj");
    EXPECT_EQ(mesh.vertices[0].x, 0.1f);
    EXPECT_EQ(mesh.vertices[0].y, 1e-45f);
    EXPECT_EQ(mesh.vertices[0].z, 0.0f);
    EXPECT_EQ(mesh.vertices[1], (Vec3{16777216, 1e30f, 3.4028235e38f}));
}

TEST(Obj, refusesWhatOthersReadAsZero) {
    const std::string face = "v 0 0 0\nv 1 0 0\nf 1 2 3\n";
    EXPECT_NE(refusal("v nan 0 0\n" + face, "x.obj").find("vertex 0 is not finite"), std::string::npos);
    EXPECT_NE(refusal("v 0 1e39 0\n" + face, "x.obj").find("vertex 0 is not finite"), std::string::npos);
    EXPECT_NE(refusal("v 0 0\n" + face, "x.obj").find("line 1"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 1x\n" + face, "x.obj").find("line 1"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\nf 1 1 2\n", "x.obj").find("uses vertex 1, but the mesh has only 1 vertex"),
              std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\r\nf 1 1 0\n", "x.obj").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\nf 1 1 -2\n", "x.obj").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\nf 1 a 1\n", "x.obj").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\nf 1 1 99999999999999999999\n", "x.obj").find("line 2"), std::string::npos);
}

const char* const kPlyHeader =
    "format %s 1.0\ncomment made by hand\nelement vertex 4\nproperty uchar red\nproperty float x\n"
    "property double y\nproperty short z\nproperty list uchar int numbers\nelement other 1\nproperty int a\n"
    "element face 2\nproperty list uchar uint vertex_indices\nproperty uchar flags\nend_header\n";

std::string plyHeader(const char* format, const char* lineEnd = "\n") {
    std::string header = "ply\n" + std::string(kPlyHeader);
    header.replace(header.find("%s"), 2, format);
    for (size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += std::strlen(lineEnd))
        header.replace(at, 1, lineEnd);
    return header;
}

std::string binaryPly(bool bigEndian) {
    Binary body(bigEndian);
    const float xs[] = {0, 1, 1, 0};
    for (int i = 0; i < 4; ++i) {
        body.add(uint8_t(200)).add(xs[i]).add(double(i / 2)).add(int16_t(-i)).add(uint8_t(i % 2));
        if (i % 2) body.add(int32_t(77));
    }
    body.add(int32_t(9));
    body.add(uint8_t(4)).addAll<uint32_t>({0, 1, 2, 3}).add(uint8_t(1));
    body.add(uint8_t(3)).addAll<uint32_t>({3, 2, 1}).add(uint8_t(1));
    return plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian") + body.text;
}

void expectTestPly(const Mesh& mesh) {
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, -1}, {1, 1, -2}, {0, 1, -3}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
}

TEST(Ply, readsTextAndBothByteOrders) {
    for (const char* lineEnd : {"\n", "\r\n", "\r"})
        expectTestPly(parsePly(
            asBytes(plyHeader("ascii", lineEnd) + "7 0 0 0 0\n7 1 0 -1 1 5\n7 1 1 -2 0\n7 0 1 -3 0\n" +
                    "9\n4 0 1 2 3 1\n3 3 2 1 1"),
            "x.ply"));
    expectTestPly(parsePly(asBytes(binaryPly(false)), "x.ply"));
    expectTestPly(parsePly(asBytes(binaryPly(true)), "x.ply"));
}

std::string plainPly(std::initializer_list<uint8_t> polygonSizes) {
    Binary body;
    body.addAll<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1});
    for (const uint8_t size : polygonSizes) {
        body.add(size);
        for (uint32_t i = 0; i < size; ++i) body.add(i);
    }
    return "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\nproperty float "
           "y\nproperty float z\n"
           "element face " +
           std::to_string(polygonSizes.size()) + "\nproperty list uchar int vertex_index\nend_header\n" +
           body.text;
}

TEST(Ply, fansPolygonsBetweenPlainTriangles) {
    EXPECT_EQ(parsePly(asBytes(plainPly({3, 5, 3, 2, 0, 4})), "x.ply").triangles,
              (Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
}

TEST(Ply, unrollsTriangleStrips) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    const std::string vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
    EXPECT_EQ(parsePly(asBytes(header + vertices + "11 0 1 2 3 4 -1 5 4 3 -1 0\n"), "x.ply").triangles,
              (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {5, 4, 3}}));
}

TEST(Ply, refusesDamage) {
    const std::string binary = plainPly({3, 3});
    EXPECT_NE(refusal(binary.substr(0, binary.size() - 1), "x.ply").find("cut short"), std::string::npos);
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_NE(refusal(text + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "x.ply").find("cut short"), std::string::npos);
    EXPECT_NE(refusal(text + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "x.ply").find("uses vertex 3"),
              std::string::npos);
    EXPECT_NE(refusal(text + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n", "x.ply").find("line 4"), std::string::npos);
    EXPECT_NE(refusal(text + "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "x.ply").find("vertex 1 is not finite"),
              std::string::npos);
    EXPECT_NE(refusal(text + "0 0 0\n1 oh 0\n0 1 0\n3 0 1 2\n", "x.ply").find("line 2"), std::string::npos);
    std::string many = plainPly({3});
    many.replace(many.find("face 1"), 6, "face 9876543210");
    EXPECT_NE(refusal(many, "x.ply").find("claims 9876543210 elements 'face'"), std::string::npos);
    EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty odd x\nend_header\n0\n", "x.ply")
                  .find("'odd'"),
              std::string::npos);
    EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "x.ply")
                  .find("x, y and z"),
              std::string::npos);
    EXPECT_NE(refusal("ply\nformat ascii 1.0\n", "x.ply").find("end_header"), std::string::npos);
}

std::string binaryStl(uint32_t claimed, uint32_t held, const char* comment = "binary") {
    Binary body;
    std::string header(comment);
    header.resize(80, ' ');
    body.add(claimed);
    for (uint32_t i = 0; i < held; ++i) {
        body.addAll<float>({0, 0, 1, 0, 0, float(i), 1, 0, float(i), 0, 1, float(i)});
        body.add(uint16_t(0));
    }
    return header + body.text;
}

const std::string kTextStl =
    "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  "
    "endloop\n endfacet\n"
    "endsolid a b\nsolid empty\nendsolid\nsolid\nfacet normal 0 0 1 outer loop vertex 0 0 1 vertex 1 0 1 "
    "vertex 1 1 1 "
    "vertex 0 1 1 endloop endfacet endsolid";

TEST(Stl, readsBinaryWhateverItsCommentSays) {
    for (const char* comment : {"binary", "solid by some program"}) {
        const Mesh mesh = readStl(asBytes(binaryStl(2, 2, comment)), "x.stl");
        EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
        EXPECT_EQ(mesh.vertices[4], (Vec3{1, 0, 1}));
    }
}

TEST(Stl, readsEverySolidOfText) {
    const Mesh mesh = readStl(asBytes(kTextStl), "x.stl");
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}}));
    EXPECT_EQ(mesh.vertices[6], (Vec3{0, 1, 1}));
}

TEST(Stl, refusesDamage) {
    EXPECT_NE(refusal(binaryStl(3, 2), "x.stl").find("claims 3 triangles, but the file ends after 2"),
              std::string::npos);
    EXPECT_NE(refusal("short", "x.stl").find("shorter"), std::string::npos);
    EXPECT_NE(refusal("solid Empty\nendsolid Empty", "x.stl").find("no triangles"), std::string::npos);
    EXPECT_NE(refusal(kTextStl.substr(0, 140), "x.stl").find("ends within a solid"), std::string::npos);
    EXPECT_NE(refusal("solid\nfacet outer loop vertex 0 0 0 vertex 1 1 1 endloop endfacet\nendsolid", "x.stl")
                  .find("fewer than three"),
              std::string::npos);
    EXPECT_NE(refusal("solid\nfacet outer loop vertex 0 0 zero", "x.stl").find("line 2"), std::string::npos);
}

TEST(MeshFiles, surviveCutsAndFlippedBits) {
    damageEverywhere("v 0 0 0\nv 1 0 0\nv 0 1.5e1 0\nf 1/1 2//2 -1\n", "x.obj");
    damageEverywhere(binaryPly(false), "x.ply");
    damageEverywhere(plainPly({3, 4, 3}), "x.ply");
    damageEverywhere(
        plyHeader("ascii") + "7 0 0 0 0\n7 1 0 -1 1 5\n7 1 1 -2 0\n7 0 1 -3 0\n9\n4 0 1 2 3 1\n3 3 2 1 1",
        "x.ply");
    damageEverywhere(binaryStl(2, 2), "x.stl");
    damageEverywhere(kTextStl, "x.stl");
}

// Fails if elements that are no triangles vanish without being counted.
TEST(MeshImport, countsPointsAndLines) {
    EXPECT_EQ(importText("v 0 0 0\np 1\np 1\nl 1 1 1\n", "x.obj").leftOut,
              (LeftOut{.points = 2, .lines = 1}));
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0\n0 0\n0 0\n";
    EXPECT_EQ(importText(ply, "x.ply").leftOut, (LeftOut{.lines = 2}));
    EXPECT_NE(refusal("v 0 0 0\n", "x.obj").find("no triangles, only vertices"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\np 1\n", "x.obj").find("no triangles, only points or lines"),
              std::string::npos);
}

}  // namespace
}  // namespace bvhio
