// Scenes from arrays: whatever a program may get wrong is refused by a line, and what is right keeps its ids.
#include <cmath>
#include <limits>

#include "api/handles.h"

namespace apitest {
namespace {

/// Expects the arrays to be refused with a status and a word of the text.
void expectRefused(const BvhioSceneArrays& arrays, BvhioStatus status, const char* word) {
    auto* scene = reinterpret_cast<BvhioScene*>(1);
    EXPECT_EQ(bvhioCreateScene(&arrays, &scene), status) << bvhioLastError();
    EXPECT_EQ(scene, nullptr);
    EXPECT_TRUE(lastErrorHas(word)) << bvhioLastError();
}

TEST(Scene, refusesAnIndexOutOfRange) {
    for (const size_t at : {0u, 100u, 383u})
        for (const uint32_t index : {81u, 0xFFFFFFFFu}) {
            Arrays arrays = grid(8);
            arrays.indices[at] = index;
            expectRefused(arrays.view(), BVHIO_INVALID,
                          ("triangle " + std::to_string(at / 3) + " has a vertex index beyond 80").c_str());
        }
}

TEST(Scene, refusesCoordinatesThatAreNotFinite) {
    for (const float value : {std::nanf(""), INFINITY, -INFINITY}) {
        Arrays arrays = grid(8);
        arrays.vertices[3 * 40 + 1] = value;
        expectRefused(arrays.view(), BVHIO_INVALID, "vertex 40 is not finite");
    }
}

TEST(Scene, refusesEmptyScenesAndMissingArrays) {
    const Arrays arrays = grid(2);
    expectRefused({}, BVHIO_INVALID, "no triangles");
    BvhioSceneArrays view = arrays.view();
    view.triangleCount = 0;
    expectRefused(view, BVHIO_INVALID, "no triangles");
    view = arrays.view();
    view.vertexCount = 0;
    expectRefused(view, BVHIO_INVALID, "no vertices");
    view = arrays.view();
    view.vertices = nullptr;
    expectRefused(view, BVHIO_USAGE, "vertices is NULL");
    view = arrays.view();
    view.indices = nullptr;
    expectRefused(view, BVHIO_USAGE, "indices is NULL");
    view = arrays.view();
    view.vertexStride = 11;
    expectRefused(view, BVHIO_USAGE, "11 bytes apart");
    EXPECT_EQ(bvhioCreateScene(nullptr, nullptr), BVHIO_USAGE);
    BvhioScene* scene = nullptr;
    EXPECT_EQ(bvhioCreateScene(nullptr, &scene), BVHIO_USAGE);
    bvhioDestroyScene(nullptr);
}

TEST(Scene, refusesCountsOverTheLimits) {
    const Arrays arrays = grid(2);
    BvhioSceneArrays view = arrays.view();
    view.triangleCount = uint64_t(1) << 31;
    expectRefused(view, BVHIO_UNSUPPORTED, "more than 2147483647 triangles");
    view.triangleCount = UINT64_MAX;
    expectRefused(view, BVHIO_UNSUPPORTED, "more than 2147483647 triangles");
    view = arrays.view();
    view.vertexCount = uint64_t(1) << 32;
    expectRefused(view, BVHIO_UNSUPPORTED, "4294967295 vertices");
}

TEST(Scene, refusesPartsThatDoNotCoverTheTriangles) {
    const Arrays arrays = grid(2);
    for (const uint32_t second : {0u, 3u, 5u, 0xFFFFFFFFu, 0xFFFFFFFCu}) {
        const BvhioPart parts[] = {{"a", 4}, {nullptr, second}};
        BvhioSceneArrays view = arrays.view();
        view.parts = parts;
        view.partCount = 2;
        expectRefused(view, BVHIO_INVALID, "triangles");
    }
    BvhioSceneArrays view = arrays.view();
    view.partCount = 2;
    expectRefused(view, BVHIO_USAGE, "parts is NULL");
}

TEST(Scene, refusesInstancesThatMakeNoSense) {
    const Arrays arrays = grid(2);
    const BvhioPart parts[] = {{"a", 4}, {"b", 4}};
    const uint32_t meshes[] = {1, 1}, tooMany[] = {1, 2}, tooFew[] = {1}, withoutAny[] = {0, 2};
    BvhioPlacement good = {0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    BvhioSceneArrays view = arrays.view();
    view.parts = parts;
    view.partCount = 2;
    view.meshes = meshes;
    view.meshCount = 2;
    expectRefused(view, BVHIO_INVALID, "meshes, but no instances");
    view.placements = &good;
    view.placementCount = 1;
    makeScene(view);

    BvhioPlacement bad = good;
    view.placements = &bad;
    bad.mesh = 2;
    expectRefused(view, BVHIO_INVALID, "only 2");
    bad = good;
    bad.objectToWorld[0] = 0;
    expectRefused(view, BVHIO_INVALID, "inverted");
    bad.objectToWorld[0] = NAN;
    expectRefused(view, BVHIO_INVALID, "inverted");
    view.placements = &good;
    view.meshes = tooMany;
    expectRefused(view, BVHIO_INVALID, "geometries");
    view.meshes = withoutAny;
    expectRefused(view, BVHIO_INVALID, "mesh 0");
    view.meshes = tooFew;
    view.meshCount = 1;
    expectRefused(view, BVHIO_INVALID, "geometries");
    view.meshes = nullptr;
    expectRefused(view, BVHIO_USAGE, "meshes is NULL");
    view = arrays.view();
    view.placementCount = 1;
    expectRefused(view, BVHIO_USAGE, "placements is NULL");
}

TEST(Scene, takesVerticesWithAStrideFromAnyAddress) {
    const Arrays arrays = grid(4);
    const size_t stride = 29;
    std::vector<char> bytes(1 + stride * (arrays.vertices.size() / 3));
    for (size_t i = 0; i < arrays.vertices.size() / 3; ++i)
        std::copy_n(reinterpret_cast<const char*>(&arrays.vertices[3 * i]), 12, &bytes[1 + i * stride]);
    BvhioSceneArrays view = arrays.view();
    view.vertices = bytes.data() + 1;
    view.vertexStride = stride;
    const Container built = build(makeScene(view).get());
    const float* xyz = nullptr;
    uint64_t count = 0;
    ASSERT_EQ(bvhioGetVertices(built.get(), &xyz, &count), BVHIO_OK);
    EXPECT_EQ(std::vector<float>(xyz, xyz + 3 * count), arrays.vertices);
}

TEST(Scene, turnsMinusZeroIntoZero) {
    Arrays arrays = grid(2);
    arrays.vertices[0] = -0.0f;
    const Container built = build(makeScene(arrays.view()).get());
    const float* xyz = nullptr;
    uint64_t count = 0;
    ASSERT_EQ(bvhioGetVertices(built.get(), &xyz, &count), BVHIO_OK);
    EXPECT_FALSE(std::signbit(xyz[0]));
}

TEST(Scene, keepsPartsAndSourceIds) {
    const Arrays arrays = grid(2);
    const BvhioPart parts[] = {{"floor", 3}, {nullptr, 0}, {"w\xC3\xA4nde", 5}};
    const uint32_t ids[] = {10, 11, 12, 7, 6, 5, 4, 3};
    BvhioSceneArrays view = arrays.view();
    view.parts = parts;
    view.partCount = 3;
    view.sourceIds = ids;
    const Container built = build(makeScene(view).get());
    BvhioGeometry geometry;
    ASSERT_EQ(bvhioGetGeometry(built.get(), 2, &geometry), BVHIO_OK);
    EXPECT_STREQ(geometry.name, "w\xC3\xA4nde");
    EXPECT_EQ(geometry.firstTriangle, 3u);
    EXPECT_EQ(geometry.triangleCount, 5u);
    ASSERT_EQ(bvhioGetGeometry(built.get(), 1, &geometry), BVHIO_OK);
    EXPECT_STREQ(geometry.name, "");
    EXPECT_EQ(bvhioGetGeometry(built.get(), 3, &geometry), BVHIO_USAGE);
    const uint32_t* stored = nullptr;
    uint64_t count = 0;
    ASSERT_EQ(bvhioGetSourceIds(built.get(), &stored, &count), BVHIO_OK);
    EXPECT_EQ(std::vector<uint32_t>(stored, stored + count), std::vector<uint32_t>(ids, ids + 8));
    const Tracer tracer = makeTracer(built.get());
    const BvhioRay ray = rayDown(0.2f, 0.2f);
    BvhioHit hit;
    ASSERT_EQ(bvhioTraceRay(tracer.get(), &ray, &hit, nullptr), 1);
    EXPECT_EQ(hit.geometry, 0u);
    EXPECT_EQ(hit.primitive, 10u);
}

}  // namespace
}  // namespace apitest
