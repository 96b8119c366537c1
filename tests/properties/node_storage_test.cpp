// Tests other ways to store the nodes of the aabb form: the same boxes must give the same hits, bit by bit.
// Also tests the effect of the order of 64-byte records on lines of 64 bytes.
#include "trace/node_storage.h"

#include <gtest/gtest.h>

#include <cstring>

#include "build/builders.h"
#include "common/shuffled_tree.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "core/error.h"
#include "core/report.h"
#include "metrics/cache_model.h"
#include "rays/ray_sets.h"
#include "relayout/layouts.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

class NodeStorageInScene : public testing::TestWithParam<test::TestScene> {};

TEST_P(NodeStorageInScene, findsTheHitsOfTheForm) {
    const Scene scene = GetParam().make();
    const std::vector<Ray> rays = test::awkwardRays(scene, 5, 5);
    for (const uint32_t maxLeafSize : {1u, 13u}) {
        const EncodedBvh bvh = AabbForm(
            test::shuffledTree(builders()[0].function(scene, {.costs = {}, .maxLeafSize = maxLeafSize}), 7));
        const Tracer plain(scene, bvh);
        std::vector<Hit> expected(rays.size()), hits(rays.size());
        std::vector<uint8_t> expectedAny(rays.size()), any(rays.size());
        plain.closestHits(rays, expected);
        plain.anyHits(rays, expectedAny);
        const TraversalCounts counts = plain.measure(rays, QueryKind::closest).counts;
        for (const NodeStorage& storage : nodeStorages()) {
            SCOPED_TRACE(testing::Message() << storage.name << " leaves of " << maxLeafSize);
            const Tracer tracer(scene, bvh, storage);
            tracer.closestHits(rays, hits);
            tracer.anyHits(rays, any);
            EXPECT_EQ(std::memcmp(hits.data(), expected.data(), rays.size() * sizeof(Hit)), 0);
            EXPECT_EQ(any, expectedAny);
            const TraversalCounts stored = tracer.measure(rays, QueryKind::closest).counts;
            EXPECT_EQ(stored.boxTests, counts.boxTests);
            EXPECT_EQ(stored.leaves, counts.leaves);
            EXPECT_EQ(stored.triangleTests, counts.triangleTests);
            EXPECT_EQ(stored.hits, counts.hits);
            const TraversalCounts ofAny = tracer.measure(rays, QueryKind::any).counts;
            EXPECT_EQ(ofAny.hits, counts.hits);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Awkward, NodeStorageInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

/// Records the fetches of nodes.
struct NodeFetches : FetchListener {
    std::vector<std::pair<uint64_t, uint32_t>> heard;
    void rayBegins(size_t) override {}
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override {
        if (array == FetchedArray::nodes) heard.emplace_back(offset, bytes);
    }
};

TEST(NodeStorage, tellsWhereItsArraysLie) {
    const Scene scene = test::sceneOf(test::randomTriangles(9, 1, 0.1f));
    const Bvh tree = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});  // 8 pairs
    const EncodedBvh bvh = AabbForm(tree);
    const Vec3 toRight = (tree.nodes[tree.nodes[0].right()].bounds).center();
    const Ray ray{toRight - Vec3{0, 0, 9}, 0, {0, 0, 1}, 100};
    const auto firstOf = [&](const char* name, size_t count) {
        NodeFetches fetches;
        FetchListener* const listeners[] = {&fetches};
        const Tracer tracer(scene, bvh, choose(nodeStorages(), "node storage", name));
        tracer.measure({&ray, 1}, QueryKind::closest, {}, listeners);
        for (const auto& [offset, bytes] : fetches.heard) EXPECT_LE(offset + bytes, tracer.arraySizes()[0]);
        fetches.heard.resize(std::min(fetches.heard.size(), count));
        return fetches.heard;
    };
    using Heard = std::vector<std::pair<uint64_t, uint32_t>>;
    EXPECT_EQ(firstOf("pairs", 2), (Heard{{0, 32}, {64, 64}}));
    EXPECT_EQ(firstOf("record", 1), (Heard{{0, 64}}));
    EXPECT_EQ(firstOf("soa32-24", 2), (Heard{{0, 32}, {256, 24}}));
    EXPECT_EQ(firstOf("soa16-8", 4), (Heard{{0, 16}, {128, 16}, {256, 16}, {384, 8}}));
}

TEST(NodeStorage, isRefusedForOtherForms) {
    const Scene scene = test::coincidentScene(5);
    const EncodedBvh bvh = SshForm::encode(scene, builders()[0].function(scene, {}), {});
    for (const NodeStorage& storage : nodeStorages()) EXPECT_THROW(Tracer(scene, bvh, storage), Error);
}

TEST(NodeStorage, isRefusedWhereReferencesAreTooShort) {
    // A leaf of 2^16 - 1 triangles among more than 2^15 others.
    const uint32_t large = kMaxLeafSize, count = large + (1 << 15) + 1;
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 0}, {1, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 1}}, 0, large};
    nodes[3] = {{{0, 0, 0}, {1, 1, 1}}, large, count - large};
    const AabbForm form(Bvh{std::move(nodes), std::vector<uint32_t>(count)});
    for (const NodeStorage& storage : nodeStorages()) {
        if (storage.name == "pairs") continue;
        EXPECT_THROW(storage.function(form), Error);
    }
}

/// Returns the misses of node records.
uint64_t misses(const Scene& scene, const Bvh& tree, std::span<const Ray> rays, const NodeStorage& storage,
                const char* cache) {
    const EncodedBvh bvh = AabbForm(tree);
    const Tracer tracer(scene, bvh, storage);
    CacheModel model(parseCaches(cache), tracer.arraySizes());
    FetchListener* const listeners[] = {&model};
    tracer.measure(rays, QueryKind::closest, {}, listeners);
    return model.report(rays.size())["misses"].get<uint64_t>();
}

// A layout must not gain with 64-byte records on 64-byte lines: for any order, a record shares its line with
// no other record. The order can only change which lines are in the same set.
TEST(NodeStorage, ofOneRecordALineMissesAlikeInAnyOrder) {
    const Scene scene =
        test::gridScene(110, [](float x, float y) { return float((int(x) * 7 + int(y) * 13) % 5); });
    const Bvh tree = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});
    ASSERT_GT(tree.nodes.size() * sizeof(Node), 32u * 32768);
    const EncodedBvh bvh = AabbForm(tree);
    const Tracer tracer(scene, bvh);
    RaySetOptions options;
    options.count = 4000;
    const RaySet set = makeRaySet("diffuse", scene, options, [&](std::span<const Ray> rays) {
        std::vector<Hit> hits(rays.size());
        tracer.closestHits(rays, hits);
        return hits;
    });
    for (const char* name : {"pairs", "record"}) {
        const NodeStorage& storage = choose(nodeStorages(), "node storage", name);
        const auto missesOf = [&](const Bvh& ordered, const char* cache) {
            return misses(scene, ordered, set.rays, storage, cache);
        };
        const Bvh depthFirst = applyNodeOrder(tree, layouts()[0].function(tree, {}).order);
        const auto ofDfs = double(missesOf(depthFirst, "32K:64:8"));
        EXPECT_GT(ofDfs, 5.0 * double(set.rays.size()));
        for (const uint64_t seed : {1, 2}) {
            const Bvh ordered = test::shuffledTree(tree, seed, false);
            EXPECT_NEAR(double(missesOf(ordered, "32K:64:8")) / ofDfs, 1, 0.02);
        }
        const uint64_t inOneSet = missesOf(depthFirst, "8K:64:128");
        for (const Layout& layout : layouts()) {
            SCOPED_TRACE(layout.name);
            EXPECT_EQ(missesOf(applyNodeOrder(tree, layout.function(tree, {}).order), "8K:64:128"), inOneSet);
        }
    }
}

}  // namespace
}  // namespace bvhio
