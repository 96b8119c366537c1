// The C++ wrapper: spans, exceptions and handles that close themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <type_traits>

#include "api/bvhio.hpp"

namespace {

const std::vector<float> kVertices = {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0};
const std::vector<uint32_t> kIndices = {0, 1, 2, 1, 3, 2};

bvhio::Scene square() {
    return bvhio::Scene({.vertices = kVertices, .indices = kIndices});
}

bvhio::Ray down(float x, float y) {
    return {{x, y, 3}, 0, {0, 0, -1}, INFINITY};
}

TEST(Wrapper, buildsSavesOpensAndShoots) {
    const bvhio::Container built =
        square().build({"builder=sweep"}, {.program = "test", .programVersion = "1"});
    const bvhio::Memory memory =
        built.relayout().restructure({"method=none"}).compress({"form=ssh"}).saveMemory();
    const bvhio::Container opened = bvhio::Container::openMemory(memory.bytes());
    EXPECT_EQ(opened.info().triangleCount, 2u);
    EXPECT_EQ(opened.vertices().size(), 4u);
    EXPECT_EQ(opened.vertices()[3], (std::array<float, 3>{4, 4, 0}));
    EXPECT_EQ(opened.triangles()[1], (std::array<uint32_t, 3>{1, 3, 2}));
    EXPECT_TRUE(opened.sourceIds().empty());
    EXPECT_EQ(opened.geometries().size(), 1u);
    EXPECT_TRUE(opened.meshes().empty());
    EXPECT_TRUE(opened.instances().empty());
    EXPECT_EQ(opened.history().size(), 4u);
    EXPECT_STREQ(opened.history()[0].program, "test");
    EXPECT_EQ(opened.chunks().size(), opened.info().chunkCount);
    EXPECT_EQ(opened.tree().primitives.size(), 2u);
    EXPECT_GT(opened.cost(), 0);
    EXPECT_EQ(opened.primitive(1).corners[1][0], 4);

    const bvhio::Tracer tracer(opened);
    bvhio::Hit hit;
    uint32_t primitive = 0;
    EXPECT_TRUE(tracer.trace(down(3, 3), hit, &primitive));
    EXPECT_EQ(primitive, 1u);
    EXPECT_EQ(hit.t, 3);
    EXPECT_TRUE(tracer.isOccluded(down(1, 1)));
    const std::vector<bvhio::Ray> rays = {down(1, 1), down(9, 9), down(3, 3)};
    std::vector<bvhio::Hit> hits(3);
    std::vector<uint32_t> primitives(3);
    std::vector<uint8_t> occluded(3);
    tracer.traceClosest(rays, hits, primitives);
    tracer.traceAny(rays, occluded);
    EXPECT_EQ(primitives, (std::vector<uint32_t>{0, BVHIO_NOTHING, 1}));
    EXPECT_EQ(occluded, (std::vector<uint8_t>{1, 0, 1}));
    EXPECT_THROW(tracer.traceAny(rays, std::span(occluded).first(2)), bvhio::Error);
}

TEST(Wrapper, takesVerticesWithAStride) {
    std::vector<float> wide;
    for (size_t i = 0; i < 4; ++i) {
        for (size_t axis = 0; axis < 3; ++axis) wide.push_back(kVertices[3 * i + axis]);
        if (i < 3) wide.insert(wide.end(), {7, 7});  // the last vertex ends the array
    }
    const bvhio::Container built =
        bvhio::Scene({.vertices = wide, .vertexStride = 20, .indices = kIndices}).build();
    EXPECT_EQ(built.info().vertexCount, 4u);
    EXPECT_EQ(built.vertices()[3], (std::array<float, 3>{4, 4, 0}));
}

TEST(Wrapper, failuresAreExceptions) {
    try {
        bvhio::Container::open("/no/such/file.bvhx");
        ADD_FAILURE();
    } catch (const bvhio::Error& error) {
        EXPECT_EQ(error.status(), BVHIO_IO);
        EXPECT_NE(std::string(error.what()).find("/no/such/file.bvhx"), std::string::npos);
    }
    EXPECT_THROW(bvhio::Container::openRange("/no/such/file.bvhx", 0, 5), bvhio::Error);
    const std::vector<uint32_t> bad = {0, 1, 9};
    EXPECT_THROW(bvhio::Scene({.vertices = kVertices, .indices = bad}), bvhio::Error);
    EXPECT_THROW(bvhio::Scene({.vertices = {}, .indices = kIndices}), bvhio::Error);
    EXPECT_THROW(square().build({"builder=best"}), bvhio::Error);
    EXPECT_THROW(square().build().tree(1), bvhio::Error);
}

TEST(Wrapper, progressCancelsOrThrows) {
    try {
        square().build({}, {.progress = [](uint64_t, uint64_t) { return false; }});
        ADD_FAILURE();
    } catch (const bvhio::Error& error) {
        EXPECT_EQ(error.status(), BVHIO_CANCELLED);
    }
    struct Mine {};
    EXPECT_THROW(square().build({}, {.progress = [](uint64_t, uint64_t) -> bool { throw Mine(); }}), Mine);
    int calls = 0;
    square().build({}, {.progress = [&](uint64_t, uint64_t) { return ++calls > 0; }});
    EXPECT_GT(calls, 0);
}

TEST(Wrapper, handlesMoveAndAreNotCopied) {
    static_assert(std::is_nothrow_move_constructible_v<bvhio::Container> &&
                  !std::is_copy_constructible_v<bvhio::Container>);
    static_assert(!std::is_copy_constructible_v<bvhio::Tracer> &&
                  !std::is_copy_constructible_v<bvhio::Scene>);
    bvhio::Container first = square().build();
    const bvhio::Container second = std::move(first);
    EXPECT_EQ(second.info().triangleCount, 2u);
    EXPECT_EQ(bvhio::version(), uint32_t(BVHIO_VERSION));
    EXPECT_EQ(bvhio::methodNames(BVHIO_FORM)[0], "aabb");
}

}  // namespace
