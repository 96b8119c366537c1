// What a container has, as the API gives it.
#include <cmath>
#include <cstring>

#include "api/handles.h"

namespace apitest {
namespace {

TEST(Version, isTheProjects) {
    EXPECT_STREQ(bvhioVersionText(), BVHIO_EXPECTED_VERSION);
    EXPECT_EQ(bvhioVersion(), uint32_t(BVHIO_VERSION));
}

TEST(Status, hasAName) {
    EXPECT_STREQ(bvhioStatusName(BVHIO_OK), "ok");
    EXPECT_STREQ(bvhioStatusName(BVHIO_USAGE), "usage");
    EXPECT_STREQ(bvhioStatusName(BVHIO_IO), "io");
    EXPECT_STREQ(bvhioStatusName(BVHIO_INVALID), "invalid");
    EXPECT_STREQ(bvhioStatusName(BVHIO_RESOURCES), "resources");
    EXPECT_STREQ(bvhioStatusName(BVHIO_UNSUPPORTED), "unsupported");
    EXPECT_STREQ(bvhioStatusName(BVHIO_CANCELLED), "cancelled");
    EXPECT_STREQ(bvhioStatusName(BvhioStatus(99)), "unknown");
}

TEST(Info, ofAPlainScene) {
    const Container built = gridContainer(8);
    const BvhioInfo info = infoOf(built.get());
    EXPECT_EQ(info.vertexCount, 81u);
    EXPECT_EQ(info.triangleCount, 128u);
    EXPECT_EQ(info.primitiveCount, 128u);
    EXPECT_EQ(info.geometryCount, 1u);
    EXPECT_EQ(info.meshCount, 0u);
    EXPECT_EQ(info.instanceCount, 0u);
    EXPECT_EQ(info.treeCount, 1u);
    EXPECT_STREQ(info.form, "aabb");
    EXPECT_EQ(info.traversalCost, 1.2f);
    EXPECT_EQ(info.intersectionCost, 1.0f);
    EXPECT_EQ(info.contentHash, 0u);
    EXPECT_EQ(info.chunkCount, 0u);
    EXPECT_EQ(info.historyCount, 1u);
    BvhioTree tree;
    ASSERT_EQ(bvhioGetTree(built.get(), 0, &tree), BVHIO_OK);
    EXPECT_EQ(info.nodeBytes, tree.nodeCount * sizeof(BvhioNode));
    EXPECT_EQ(bvhioGetInfo(nullptr, nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetInfo(built.get(), nullptr), BVHIO_USAGE);
}

TEST(Info, ofAnInstancedScene) {
    const Container built = build(instancedScene().get());
    const BvhioInfo info = infoOf(built.get());
    EXPECT_EQ(info.triangleCount, 33u);
    EXPECT_EQ(info.primitiveCount, 65u);
    EXPECT_EQ(info.geometryCount, 2u);
    EXPECT_EQ(info.meshCount, 2u);
    EXPECT_EQ(info.instanceCount, 3u);
    EXPECT_EQ(info.treeCount, 3u);
    EXPECT_STREQ(info.form, "two-level");

    BvhioMesh mesh;
    ASSERT_EQ(bvhioGetMesh(built.get(), 1, &mesh), BVHIO_OK);
    EXPECT_EQ(mesh.firstGeometry, 1u);
    EXPECT_EQ(mesh.geometryCount, 1u);
    EXPECT_EQ(mesh.firstTriangle, 32u);
    EXPECT_EQ(mesh.triangleCount, 1u);
    EXPECT_EQ(bvhioGetMesh(built.get(), 2, &mesh), BVHIO_USAGE);

    BvhioInstance instance;
    ASSERT_EQ(bvhioGetInstance(built.get(), 1, &instance), BVHIO_OK);
    EXPECT_EQ(instance.objectToWorld[3], 100);
    EXPECT_EQ(instance.mesh, 0u);
    EXPECT_EQ(instance.firstPrimitive, 32u);
    EXPECT_EQ(instance.firstGeometry, 1u);
    EXPECT_EQ(bvhioGetInstance(built.get(), 3, &instance), BVHIO_USAGE);
    EXPECT_STREQ(bvhioLastError(), "there is no instance 3: there are 3");
}

TEST(Chunks, areListedInFileOrder) {
    const Container built = gridContainer();
    const Bytes bytes = saved(built.get());
    BvhioContainer* handle = nullptr;
    ASSERT_EQ(bvhioOpenMemory(bytes.data.get(), bytes.size, 0, nullptr, &handle), BVHIO_OK);
    const Container opened(handle);
    std::string types;
    for (uint32_t i = 0; i < infoOf(handle).chunkCount; ++i) {
        BvhioChunk chunk;
        ASSERT_EQ(bvhioGetChunk(handle, i, &chunk), BVHIO_OK);
        types += std::string(chunk.type) + " ";
        EXPECT_EQ(std::memcmp(bytes.begin() + chunk.offset, chunk.type, 4), 0);
        EXPECT_STREQ(chunk.codec, "none");
        EXPECT_EQ(chunk.rawSize, chunk.storedSize);
    }
    EXPECT_EQ(types, "SCEN VERT TRIS GEOM TREE NODE PRIM PROV END  ");
    BvhioChunk chunk;
    EXPECT_EQ(bvhioGetChunk(handle, 9, &chunk), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetChunk(built.get(), 0, &chunk), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetChunk(handle, 0, nullptr), BVHIO_USAGE);
}

TEST(Arrays, areThoseOfTheScene) {
    const Arrays arrays = grid(5);
    const Container built = gridContainer(5);
    const float* xyz = nullptr;
    const uint32_t *indices = nullptr, *ids = &arrays.indices[0];
    uint64_t count = 0;
    ASSERT_EQ(bvhioGetVertices(built.get(), &xyz, &count), BVHIO_OK);
    EXPECT_EQ(std::vector<float>(xyz, xyz + 3 * count), arrays.vertices);
    ASSERT_EQ(bvhioGetTriangles(built.get(), &indices, &count), BVHIO_OK);
    EXPECT_EQ(std::vector<uint32_t>(indices, indices + 3 * count), arrays.indices);
    ASSERT_EQ(bvhioGetSourceIds(built.get(), &ids, &count), BVHIO_OK);
    EXPECT_EQ(ids, nullptr);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(bvhioGetVertices(nullptr, &xyz, &count), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetVertices(built.get(), nullptr, &count), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetTriangles(built.get(), &indices, nullptr), BVHIO_USAGE);
}

/// Counts each primitive that a leaf has, and expects boxes to nest.
std::vector<int> visitsOf(const BvhioTree& tree) {
    std::vector<int> visits(tree.primitiveCount);
    for (uint64_t i = 0; i < tree.nodeCount; ++i) {
        const BvhioNode& node = tree.nodes[i];
        if (i == 1) continue;
        for (uint32_t k = 0; node.count > 0 && k < node.count; ++k) ++visits[node.first + k];
        for (uint32_t child = 0; node.count == 0 && child < 2; ++child) {
            EXPECT_GT(node.first, i);
            EXPECT_EQ(node.first % 2, 0u);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(node.min[axis], tree.nodes[node.first + child].min[axis]);
                EXPECT_GE(node.max[axis], tree.nodes[node.first + child].max[axis]);
            }
        }
    }
    return visits;
}

TEST(Tree, coversEveryPrimitiveOnce) {
    const Container plain = gridContainer(), instanced = build(instancedScene().get());
    for (const Container* container : {&plain, &instanced})
        for (uint64_t i = 0; i < infoOf(container->get()).treeCount; ++i) {
            BvhioTree tree;
            ASSERT_EQ(bvhioGetTree(container->get(), i, &tree), BVHIO_OK) << bvhioLastError();
            EXPECT_EQ(visitsOf(tree), std::vector<int>(tree.primitiveCount, 1)) << i;
        }
    BvhioTree tree;
    ASSERT_EQ(bvhioGetTree(instanced.get(), 0, &tree), BVHIO_OK);
    EXPECT_EQ(tree.primitiveCount, 3u);
    ASSERT_EQ(bvhioGetTree(instanced.get(), 1, &tree), BVHIO_OK);
    EXPECT_EQ(tree.primitiveCount, 32u);
    ASSERT_EQ(bvhioGetTree(instanced.get(), 2, &tree), BVHIO_OK);
    EXPECT_EQ(tree.primitiveCount, 1u);
    EXPECT_EQ(tree.primitives[0], 0u);
    EXPECT_EQ(bvhioGetTree(instanced.get(), 3, &tree), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetTree(plain.get(), 1, &tree), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetTree(plain.get(), 0, nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetTree(nullptr, 0, &tree), BVHIO_USAGE);
}

TEST(Primitive, isFoundThroughInstances) {
    const Container instanced = build(instancedScene().get());
    BvhioPrimitive primitive;
    ASSERT_EQ(bvhioGetPrimitive(instanced.get(), 35, &primitive), BVHIO_OK);
    EXPECT_EQ(primitive.geometry, 1u);
    EXPECT_EQ(primitive.sourceId, 3u);
    EXPECT_EQ(primitive.instance, 1u);
    EXPECT_EQ(primitive.triangle, 3u);
    EXPECT_EQ(primitive.corners[0][0], 102);
    ASSERT_EQ(bvhioGetPrimitive(instanced.get(), 64, &primitive), BVHIO_OK);
    EXPECT_EQ(primitive.geometry, 2u);
    EXPECT_EQ(primitive.instance, 2u);
    EXPECT_EQ(primitive.triangle, 32u);
    EXPECT_EQ(primitive.corners[1][2], 50);
    EXPECT_EQ(bvhioGetPrimitive(instanced.get(), 65, &primitive), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetPrimitive(instanced.get(), 0, nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetPrimitive(nullptr, 0, &primitive), BVHIO_USAGE);
}

TEST(LastError, belongsToTheThreadAndIsCut) {
    EXPECT_EQ(bvhioOpenFile("/no/such/file.bvhx", 0, nullptr, nullptr), BVHIO_USAGE);
    const std::string longPath = "/no/" + std::string(3000, 'x');
    BvhioContainer* handle = nullptr;
    EXPECT_EQ(bvhioOpenFile(longPath.c_str(), 0, nullptr, &handle), BVHIO_IO);
    EXPECT_EQ(std::strlen(bvhioLastError()), 1000u);
}

}  // namespace
}  // namespace apitest
