#include "importers/draco_mesh.h"

#include <draco/compression/encode.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/aabb.h"
#include "core/error.h"

namespace bvhio {
namespace {

struct TestMesh {
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;
};

/// A mesh whose order a compressor would like to change: random triangles over a random cloud, some of them
/// degenerate, some vertices equal, some unused.
TestMesh scrambledMesh(uint32_t vertexCount, uint32_t triangleCount) {
    std::mt19937 random(7);
    TestMesh mesh;
    for (uint32_t i = 0; i < vertexCount; ++i) {
        const auto coordinate = [&] { return float(random() % 1000) / 8 - 50; };
        mesh.vertices.push_back({coordinate(), coordinate(), coordinate()});
        if (i % 7 == 3) mesh.vertices[i] = mesh.vertices[i / 2];
    }
    for (uint32_t i = 0; i < triangleCount; ++i) {
        const auto index = [&] { return uint32_t(random() % (vertexCount - 1)); };
        mesh.triangles.push_back({index(), index(), index()});
        if (i % 11 == 5) mesh.triangles[i].v2 = mesh.triangles[i].v0;
    }
    return mesh;
}

void expectClose(const std::vector<Vec3>& decoded, const std::vector<Vec3>& expected, int bits) {
    ASSERT_EQ(decoded.size(), expected.size());
    Aabb bounds = Aabb::empty();
    for (const Vec3& v : expected) bounds.extend(v);
    const float step = bounds.extent()[bounds.longestAxis()] / float((1u << bits) - 1);
    for (size_t i = 0; i < expected.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_NEAR(decoded[i][axis], expected[i][axis], step * 0.51f + 1e-5f) << "vertex " << i;
}

TEST(DracoMesh, keepsTheOrderOfVerticesAndTriangles) {
    // The index width of Draco's sequential method changes at 256, 65,536 and 2^21 vertices.
    for (const uint32_t vertexCount : {4u, 200u, 300u, 70000u, 2100000u}) {
        const TestMesh mesh = scrambledMesh(vertexCount, vertexCount / 2 + 10);
        for (const int bits : {8, 14, 20}) {
            const auto bytes = encodeDraco(mesh.vertices, mesh.triangles, bits);
            const DracoMesh decoded = decodeDraco(bytes, "test");
            ASSERT_EQ(decoded.triangles, mesh.triangles) << vertexCount;
            expectClose(decoded.vertices, mesh.vertices, bits);
            if (vertexCount > 1000000) break;
        }
    }
}

TEST(DracoMesh, keepsMeshesThatCompressToAlmostNothing) {
    // Below three bytes per triangle Draco's decoder refuses what its encoder wrote.
    const std::vector<TriangleIndices> sameTriangle(100000, TriangleIndices{0, 1, 2});
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(decodeDraco(encodeDraco(corners, sameTriangle, 10), "test").triangles, sameTriangle);

    const std::vector<Vec3> samePoint(300000, Vec3{1, 2, 3});
    const DracoMesh decoded = decodeDraco(encodeDraco(samePoint, sameTriangle, 10), "test");
    EXPECT_EQ(decoded.vertices, samePoint);
    EXPECT_EQ(decoded.triangles, sameTriangle);
}

TEST(DracoMesh, givesTheSameBytesTwice) {
    const TestMesh mesh = scrambledMesh(300, 600);
    EXPECT_EQ(encodeDraco(mesh.vertices, mesh.triangles, 14), encodeDraco(mesh.vertices, mesh.triangles, 14));
}

TEST(DracoMesh, refusesWhatItCannotEncode) {
    const std::vector<TriangleIndices> triangle{{0, 1, 2}};
    const std::vector<Vec3> wide{{-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 1, 0}};
    EXPECT_THROW(encodeDraco(wide, triangle, 14), Error);
    EXPECT_THROW(encodeDraco(std::vector<Vec3>(4), triangle, 14), Error);
    const std::vector<Vec3> fine{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_THROW(encodeDraco(fine, triangle, 0), Error);
    EXPECT_THROW(encodeDraco(fine, triangle, 31), Error);
    EXPECT_EQ(decodeDraco(encodeDraco(fine, triangle, kMaxDracoPositionBits), "test").vertices, fine);
}

TEST(DracoMesh, refusesClaimsThatTheDataCannotHold) {
    const TestMesh mesh = scrambledMesh(10, 20);
    std::vector<std::byte> bytes = encodeDraco(mesh.vertices, mesh.triangles, 8);
    // Bytes 11 and 12 are the counts of triangles and vertices, as variable-length integers.
    ASSERT_EQ(bytes[11], std::byte{20});
    ASSERT_EQ(bytes[12], std::byte{10});
    std::vector<std::byte> manyPoints(bytes.begin(), bytes.begin() + 12);
    for (const int b : {0xff, 0xff, 0xff, 0xff, 0x07}) manyPoints.push_back(std::byte(b));
    manyPoints.insert(manyPoints.end(), bytes.begin() + 13, bytes.end());
    EXPECT_THROW(decodeDraco(manyPoints, "test"), Error);

    bytes[12] = std::byte{3};  // fewer vertices than the triangles use
    EXPECT_THROW(decodeDraco(bytes, "test"), Error);
}

std::vector<std::byte> edgebreaker(const TestMesh& source) {
    draco::Mesh mesh;
    mesh.set_num_points(uint32_t(source.vertices.size()));
    draco::GeometryAttribute position;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, sizeof(Vec3), 0);
    const int id = mesh.AddAttribute(position, true, uint32_t(source.vertices.size()));
    mesh.attribute(id)->buffer()->Write(0, source.vertices.data(), source.vertices.size() * sizeof(Vec3));
    for (const TriangleIndices& t : source.triangles)
        mesh.AddFace({draco::PointIndex(t.v0), draco::PointIndex(t.v1), draco::PointIndex(t.v2)});
    draco::Encoder encoder;
    encoder.SetSpeedOptions(0, 0);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 11);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
    return {begin, begin + buffer.size()};
}

/// A flat grid of n x n quads: the easiest mesh to compress.
TestMesh grid(uint32_t n) {
    TestMesh mesh;
    for (uint32_t y = 0; y <= n; ++y)
        for (uint32_t x = 0; x <= n; ++x) mesh.vertices.push_back({float(x), float(y), 0});
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t v = y * (n + 1) + x;
            mesh.triangles.push_back({v, v + 1, v + n + 1});
            mesh.triangles.push_back({v + 1, v + n + 2, v + n + 1});
        }
    return mesh;
}

TEST(DracoMesh, decodesVeryDenseEdgebreakerData) {
    const TestMesh mesh = grid(500);
    const auto bytes = edgebreaker(mesh);
    const DracoMesh decoded = decodeDraco(bytes, "test");
    EXPECT_EQ(decoded.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(decoded.vertices.size(), mesh.vertices.size());
}

TEST(DracoMesh, survivesCutsAndFlippedBits) {
    for (const auto& whole :
         {encodeDraco(scrambledMesh(20, 30).vertices, scrambledMesh(20, 30).triangles, 10),
          edgebreaker(grid(6))}) {
        ASSERT_NO_THROW(decodeDraco(whole, "test"));
        for (size_t length = 0; length < whole.size(); ++length)
            EXPECT_THROW(decodeDraco(std::span(whole).first(length), "test"), Error) << length;
        for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
            std::vector<std::byte> damaged = whole;
            damaged[bit / 8] ^= std::byte(1 << bit % 8);
            try {
                const DracoMesh mesh = decodeDraco(damaged, "test");
                for (const TriangleIndices& t : mesh.triangles)
                    ASSERT_LT(std::max({t.v0, t.v1, t.v2}), mesh.vertices.size());
            } catch (const Error& error) {
                ASSERT_EQ(error.kind(), ErrorKind::invalid);
            }
        }
    }
}

}  // namespace
}  // namespace bvhio
