// Storing trees in every form, with every codec: the hits stay, nodes can be decoded, and bad options are refused.
#include <cstring>

#include "api/handles.h"

namespace apitest {
namespace {

Container compress(const BvhioContainer* from, std::vector<const char*> options = {}) {
    options.push_back(nullptr);
    BvhioContainer* result = nullptr;
    EXPECT_EQ(bvhioCompress(from, options.data(), nullptr, &result), BVHIO_OK) << bvhioLastError();
    return Container(result);
}

Container reopened(const Bytes& bytes, uint32_t flags = 0) {
    BvhioContainer* handle = nullptr;
    EXPECT_EQ(bvhioOpenMemory(bytes.data.get(), bytes.size, flags, nullptr, &handle), BVHIO_OK)
        << bvhioLastError();
    return Container(handle);
}

std::vector<BvhioHit> hitsOf(const BvhioContainer* container) {
    const Tracer tracer = makeTracer(container);
    std::vector<BvhioRay> rays;
    for (int i = 0; i < 400; ++i) rays.push_back(rayDown(float(i % 20) * 0.83f, float(i / 20) * 0.79f));
    std::vector<BvhioHit> hits(rays.size());
    EXPECT_EQ(bvhioTraceClosest(tracer.get(), rays.data(), rays.size(), hits.data(), nullptr, 1), BVHIO_OK);
    return hits;
}

void expectSameHits(const BvhioContainer* a, const BvhioContainer* b) {
    const auto hitsA = hitsOf(a), hitsB = hitsOf(b);
    EXPECT_EQ(std::memcmp(hitsA.data(), hitsB.data(), hitsA.size() * sizeof(BvhioHit)), 0);
}

/// Whether a walk over the decoded nodes meets each primitive.
bool coversAll(const BvhioContainer* container, uint64_t triangles) {
    BvhioTree tree;
    EXPECT_EQ(bvhioGetTree(container, 0, &tree), BVHIO_OK) << bvhioLastError();
    std::vector<bool> met(triangles);
    std::vector<uint32_t> stack{0};
    while (!stack.empty()) {
        const BvhioNode& node = tree.nodes[stack.back()];
        stack.pop_back();
        for (uint32_t i = 0; i < node.count; ++i) met[tree.primitives[node.first + i]] = true;
        if (node.count == 0) stack.insert(stack.end(), {node.first, node.first + 1});
    }
    return std::find(met.begin(), met.end(), false) == met.end();
}

TEST(Compress, everyFormKeepsTheHitsAndIsDecoded) {
    const Container built = gridContainer(16);
    for (uint64_t i = 0; i < bvhioMethodCount(BVHIO_FORM); ++i) {
        const std::string name = bvhioMethodName(BVHIO_FORM, i), option = "form=" + name;
        SCOPED_TRACE(name);
        const Container changed = compress(built.get(), {option.c_str()});
        EXPECT_EQ(infoOf(changed.get()).form, name);
        EXPECT_TRUE(i == 0 || infoOf(changed.get()).nodeBytes < infoOf(built.get()).nodeBytes);
        const Bytes bytes = saved(changed.get());
        for (const uint32_t flags : {0u, BVHIO_TRUSTED}) {
            const Container back = reopened(bytes, flags);
            EXPECT_EQ(infoOf(back.get()).form, name);
            expectSameHits(built.get(), back.get());
            EXPECT_TRUE(coversAll(back.get(), 512));
        }
    }
}

TEST(Compress, storesInstancedScenesInTwoLevels) {
    const Container built = build(instancedScene().get());
    const Container changed = compress(built.get());
    EXPECT_STREQ(infoOf(changed.get()).form, "two-level");
    EXPECT_LT(infoOf(changed.get()).nodeBytes, infoOf(built.get()).nodeBytes);
    for (const uint32_t flags : {0u, BVHIO_TRUSTED})
        expectSameHits(built.get(), reopened(saved(changed.get()), flags).get());
    const char* options[] = {"form=quantized", nullptr};
    BvhioContainer* result = nullptr;
    EXPECT_EQ(bvhioCompress(built.get(), options, nullptr, &result), BVHIO_USAGE);
    EXPECT_TRUE(lastErrorHas("has instances")) << bvhioLastError();
}

TEST(Compress, codecsAndGeometryMakeSavedFilesSmaller) {
    const Container built = gridContainer(64);
    const size_t plain = saved(built.get()).size;
    const Container zstd = compress(built.get(), {"form=aabb"});
    const size_t squeezed = saved(zstd.get()).size;
    EXPECT_LT(squeezed, plain);
    const size_t topology = saved(compress(built.get(), {"codec=topology"}).get()).size;
    EXPECT_LT(topology, squeezed);
    const Container draco = compress(built.get(), {"form=aabb", "geometry=draco", "position-bits=10"});
    const Bytes rounded = saved(draco.get());
    const Container decoded = reopened(rounded);
    EXPECT_EQ(infoOf(decoded.get()).triangleCount, 8192u);
    BvhioChunk geometry;
    ASSERT_EQ(bvhioGetChunk(decoded.get(), 1, &geometry), BVHIO_OK);
    EXPECT_STREQ(geometry.type, "DRCO");
    expectSameHits(built.get(), reopened(saved(zstd.get())).get());
    expectSameHits(built.get(), compress(built.get(), {"triangle-order=leaf", "vertex-order=use"}).get());
    EXPECT_EQ(saved(compress(built.get(), {"form=aabb", "codec=none"}).get()).size / 1000, plain / 1000);

    // Chunks say which codec they have; the others come back as they were.
    const Bytes bytes = saved(zstd.get());
    const Container opened = reopened(bytes);
    BvhioChunk chunk;
    ASSERT_EQ(bvhioGetChunk(opened.get(), 2, &chunk), BVHIO_OK);
    EXPECT_STREQ(chunk.type, "TRIS");
    EXPECT_STRNE(chunk.codec, "none");
    EXPECT_LT(chunk.storedSize, chunk.rawSize);
}

TEST(Compress, aCompactFormStaysWhatItIs) {
    const Container small = compress(gridContainer().get(), {"form=quantized", "bits=6"});
    const Container again = compress(small.get());
    EXPECT_STREQ(infoOf(again.get()).form, "quantized");
    BvhioHistory history;
    ASSERT_EQ(bvhioGetHistory(again.get(), 2, &history), BVHIO_OK);
    EXPECT_NE(std::string(history.options).find("\"pass\":\"compress\",\"form\":\"quantized\""),
              std::string::npos)
        << history.options;
    EXPECT_NE(std::string(history.options).find("\"bits\":6"), std::string::npos) << history.options;
}

TEST(Compress, refusesOptionsByALineThatSaysWhatIsAllowed) {
    const Container container = gridContainer();
    const struct {
        std::vector<const char*> options;
        const char* word;
    } cases[] = {
        {{"form=best"}, "unknown form 'best': use aabb"},
        {{"codec=lzma"}, "use none"},
        {{"codec=zstd", "level=20"}, "from 0 to 19"},
        {{"form=quantized", "bits=4"}, "from 5 to 8"},
        {{"form=quantized", "leaf-size=4"}, "form quantized does not use it"},
        {{"form=two-level", "blas-form=best"}, "blas-form"},
        {{"form=mvh", "zeta=7"}, "zeta"},
        {{"form=quantized", "codec=topology"}, "topology is for form aabb"},
        {{"size=9"}, "unknown option 'size': use form, codec"},
        {{"geometry=round"}, "use raw or draco"},
        {{"position-bits=31"}, "from 1 to 30"},
        {{"triangle-order=use"}, "use source or leaf"},
        {{"vertex-order=leaf"}, "use auto, source or use"},
    };
    for (const auto& [given, word] : cases) {
        std::vector<const char*> options = given;
        options.push_back(nullptr);
        BvhioContainer* result = container.get();
        EXPECT_EQ(bvhioCompress(container.get(), options.data(), nullptr, &result), BVHIO_USAGE) << given[0];
        EXPECT_EQ(result, nullptr);
        EXPECT_TRUE(lastErrorHas(word)) << bvhioLastError();
    }
    BvhioContainer* result = nullptr;
    EXPECT_EQ(bvhioCompress(nullptr, nullptr, nullptr, &result), BVHIO_USAGE);
    EXPECT_EQ(bvhioCompress(container.get(), nullptr, nullptr, nullptr), BVHIO_USAGE);
}

TEST(Compress, canBeCancelled) {
    const Container container = gridContainer();
    const BvhioContext context = {0, [](void*, uint64_t, uint64_t) { return 1; }, nullptr, nullptr, nullptr};
    BvhioContainer* result = nullptr;
    EXPECT_EQ(bvhioCompress(container.get(), nullptr, &context, &result), BVHIO_CANCELLED);
    EXPECT_EQ(result, nullptr);
}

}  // namespace
}  // namespace apitest
