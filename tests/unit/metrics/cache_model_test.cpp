#include "metrics/cache_model.h"

#include <gtest/gtest.h>

#include <list>
#include <sstream>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/report.h"
#include "metrics/fetch_table.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

TEST(Cache, matchesHandWorkedHits) {
    const CacheLevel twoSetsOfTwo{256, 64, 2};
    Cache cache({&twoSetsOfTwo, 1}, 4096);
    const auto missesAfter = [&](uint64_t address, uint64_t bytes) {
        cache.touch(address, bytes);
        return cache.counts(0).misses;
    };
    EXPECT_EQ(missesAfter(0, 64), 1u);    // line 0 into set 0
    EXPECT_EQ(missesAfter(60, 4), 1u);    // the same line
    EXPECT_EQ(missesAfter(128, 64), 2u);  // line 2, the other way of set 0
    EXPECT_EQ(missesAfter(64, 64), 3u);   // line 1 into set 1
    EXPECT_EQ(missesAfter(0, 1), 3u);     // line 0 is now the one touched last
    EXPECT_EQ(missesAfter(256, 1), 4u);   // line 4 takes line 2's place, not line 0's
    EXPECT_EQ(missesAfter(0, 1), 4u);
    EXPECT_EQ(missesAfter(128, 1), 5u);     // so line 2 is gone; it takes line 4's place
    EXPECT_EQ(missesAfter(60, 8), 5u);      // over the end of line 0 into line 1: both are held
    EXPECT_EQ(missesAfter(188, 8), 6u);     // of lines 2 and 3, line 2 is
    EXPECT_EQ(missesAfter(512, 256), 10u);  // all four are replaced
    EXPECT_EQ(missesAfter(0, 256), 14u);
    EXPECT_EQ(cache.counts(0).hits, 6u);
}

TEST(Cache, nextLevelSeesMissesAlone) {
    const CacheLevel levels[] = {{64, 64, 1}, {512, 128, 2}};
    Cache cache(levels, 4096);
    for (const uint64_t address : {0, 0, 64, 0, 128, 128}) cache.touch(address, 8);
    EXPECT_EQ(cache.counts(0), (CacheCounts{2, 4}));
    EXPECT_EQ(cache.counts(1), (CacheCounts{2, 2}));  // lines of 128: 0, 0, 0, 1
}

TEST(Cache, nextLevelWithShorterLinesIsAskedForEachOfThem) {
    const CacheLevel levels[] = {{128, 128, 1}, {512, 32, 4}};
    Cache cache(levels, 4000);
    cache.touch(3990, 1);
    EXPECT_EQ(cache.counts(0), (CacheCounts{0, 1}));
    EXPECT_EQ(cache.counts(1), (CacheCounts{0, 4}));
}

/// Counts misses in a simple way: each set is a list, the most recent line first.
CacheCounts slowly(const CacheLevel& level, std::span<const std::pair<uint64_t, uint64_t>> fetches) {
    std::vector<std::list<uint64_t>> sets(std::min<uint64_t>(level.sets(), 1 << 16));  // more stay empty
    CacheCounts counts;
    for (const auto& [address, bytes] : fetches)
        for (uint64_t line = address / level.line; line * level.line < address + bytes; ++line) {
            auto& set = sets[line % sets.size()];
            const auto found = std::find(set.begin(), set.end(), line);
            ++(found == set.end() ? counts.misses : counts.hits);
            if (found != set.end()) set.erase(found);
            set.push_front(line);
            if (set.size() > level.ways) set.pop_back();
        }
    return counts;
}

TEST(Cache, agreesWithASlowOne) {
    Random random(3);
    constexpr uint64_t kSpan = 20000;
    std::vector<std::pair<uint64_t, uint64_t>> fetches;
    uint64_t around = 0;
    for (int i = 0; i < 20000; ++i) {
        if (random.below(10) == 0) around = random.below(kSpan);
        const uint64_t address = std::min<uint64_t>(around + random.below(600), kSpan - 1);
        fetches.emplace_back(address, 1 + random.below(uint32_t(std::min<uint64_t>(100, kSpan - address))));
    }
    // One set, one way, a number of sets that is not a power of two, and levels that stay partly or mostly
    // empty.
    for (const CacheLevel& level :
         {CacheLevel{1024, 64, 16}, CacheLevel{1024, 64, 1}, CacheLevel{2048, 64, 8}, CacheLevel{1152, 32, 6},
          CacheLevel{2400 * 16, 16, 8}, CacheLevel{uint64_t(1) << 40, 64, 8},
          CacheLevel{1024 * 4096, 4096, 1024}, CacheLevel{4096 * 64, 4096, 64}, CacheLevel{24576, 128, 3}}) {
        SCOPED_TRACE(formatCacheLevel(level));
        Cache cache({&level, 1}, kSpan);
        for (const auto& [address, bytes] : fetches) cache.touch(address, bytes);
        EXPECT_EQ(cache.counts(0), slowly(level, fetches));
    }
}

TEST(CacheText, isReadAndWritten) {
    const auto caches = parseCaches("32K:64:8,1M:64:16+256K:4K:64");
    ASSERT_EQ(caches.size(), 2u);
    EXPECT_EQ(caches[0], (CacheLevels{{32768, 64, 8}, {1 << 20, 64, 16}}));
    EXPECT_EQ(caches[1], (CacheLevels{{262144, 4096, 64}}));
    EXPECT_EQ(caches[0][0].sets(), 64u);
    EXPECT_EQ(formatCacheLevel(caches[0][1]), "1M:64:16");
    EXPECT_EQ(formatCacheLevel({48 * 1024, 64, 12}), "48K:64:12");
    EXPECT_EQ(formatCacheLevel({1500, 4, 1}), "1500:4:1");
    EXPECT_EQ(parseCaches("1024G:1G:1024")[0][0].bytes, uint64_t(1) << 40);
}

TEST(CacheText, isRefusedWhereItMakesNoCache) {
    for (const char* text : {"",
                             "32K",
                             "32K:64",
                             "32K:64:8:1",
                             "32K:64:0",
                             "32K:63:8",
                             "32K:0:8",
                             "32K:8:8",
                             "0:64:8",
                             "-1:64:8",
                             "33000:64:8",
                             "32:64:8",
                             "32K:64:1025",
                             "32K:64:-8",
                             "32k:64:8",
                             "32KB:64:8",
                             "1.5K:64:8",
                             " 32K:64:8",
                             "99999999999999999999:64:8",
                             "1025G:64:8",
                             "1099511627776K:64:8",
                             "32K:2G:8",
                             "32K:64:8,",
                             "32K:64:8+",
                             ",32K:64:8",
                             "32K:64:8;32K:64:8",
                             "1K:64:1+1K:64:1+1K:64:1,1K:64:1+1K:64:1+1K:64:1+1K:64:1+1K:64:1+1K:64:1"})
        EXPECT_THROW(parseCaches(text), Error) << text;
}

/// Records the fetches that a listener receives.
struct Recorder : FetchListener {
    std::vector<std::array<uint64_t, 4>> heard;
    uint64_t ray = 0;

    void rayBegins(size_t index) override { ray = index; }
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override {
        heard.push_back({ray, uint64_t(array), offset, bytes});
    }
};

TEST(Fetches, areToldRayByRayWithTheirPlaces) {
    const Scene scene = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}});
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 0}, {6, 1, 0}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 0}}, 1, 1};  // triangle 0, the second in the order of leaves
    nodes[3] = {{{5, 0, 0}, {6, 1, 0}}, 0, 1};
    const EncodedBvh bvh = AabbForm(Bvh{std::move(nodes), std::vector<uint32_t>{1, 0}});
    const Tracer tracer(scene, bvh);
    const Ray rays[] = {{{3, 0.25f, 9}, 0, {0, 0, -1}, 100}, {{0.25f, 0.25f, 9}, 0, {0, 0, -1}, 100}};

    Recorder recorder;
    std::ostringstream text;
    const uint32_t order[] = {7, 4};
    FetchTable table(text, order);
    FetchListener* const listeners[] = {&recorder, &table};
    tracer.measure(rays, QueryKind::closest, {}, listeners);
    EXPECT_EQ(recorder.heard, (std::vector<std::array<uint64_t, 4>>{{0, 0, 0, 32},
                                                                    {0, 0, 64, 64},
                                                                    {1, 0, 0, 32},
                                                                    {1, 0, 64, 64},
                                                                    {1, 1, 4, 4},
                                                                    {1, 2, 0, 12},
                                                                    {1, 3, 0, 12},
                                                                    {1, 3, 12, 12},
                                                                    {1, 3, 24, 12}}));
    EXPECT_EQ(text.str(),
              "ray,array,offset,bytes\n7,nodes,0,32\n7,nodes,64,64\n4,nodes,0,32\n4,nodes,64,64\n"
              "4,primitives,4,4\n4,indices,0,12\n4,vertices,0,12\n4,vertices,12,12\n4,vertices,24,12\n");
    EXPECT_EQ(tracer.arraySizes(), (FetchedArraySizes{128, 8, 24, 72}));
}

// The array after the slots, which says where leaves end, is read, too.
TEST(Fetches, tellWhereLeavesOfShortRecordsEnd) {
    const Triangle near{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, far{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    const Scene scene = test::sceneOf({near, near, far, far});
    AlignedVector<Node> nodes(4);
    nodes[0] = {{{0, 0, 0}, {6, 1, 0}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 0}}, 0, 2};
    nodes[3] = {{{5, 0, 0}, {6, 1, 0}}, 2, 2};
    const Bvh tree{std::move(nodes), std::vector<uint32_t>{0, 1, 2, 3}};
    const EncodedBvh bvh = QuantizedShortForm::encode(scene, tree, {});
    const Ray rays[] = {{{0.25f, 0.25f, 9}, 0, {0, 0, -1}, 100}};
    Recorder recorder;
    FetchListener* const listeners[] = {&recorder};
    const Tracer tracer(scene, bvh);
    const TraceMeasurement measured = tracer.measure(rays, QueryKind::closest, {}, listeners);
    ASSERT_EQ(recorder.heard.size(), 2u + 2 * 5);
    EXPECT_EQ(recorder.heard[0], (std::array<uint64_t, 4>{0, 0, 0, 8}));
    EXPECT_EQ(recorder.heard[1], (std::array<uint64_t, 4>{0, 0, 8, 8}));
    EXPECT_EQ(tracer.arraySizes()[0], 16u);
    EXPECT_EQ(measured.counts.recordBytes, 16u);
}

TEST(CacheModel, countsEachArrayApartAndAllTogether) {
    CacheModel model(parseCaches("1K:64:16,2K:64:32+4K:4K:1"), {640, 4, 12, 36});
    for (int round = 0; round < 2; ++round)
        for (uint64_t node = 0; node < 10; ++node) {
            model.fetched(FetchedArray::nodes, 64 * node, 64);
            model.fetched(FetchedArray::vertices, 12, 12);
        }
    const Report report = model.report(5);
    EXPECT_EQ(report["hits"], 10);
    EXPECT_EQ(report["misses"], 10);
    EXPECT_EQ(report["bytes"], 640);
    ASSERT_EQ(report["nodes"].size(), 3u);
    EXPECT_EQ(report["nodes"][0]["misses_per_ray"], 2);
    EXPECT_EQ(report["nodes"][1]["level"], "2K:64:32");
    EXPECT_EQ(report["nodes"][1]["fed_by"], "1K:64:16");
    EXPECT_EQ(report["nodes"][1]["misses"], 10);
    EXPECT_EQ(report["nodes"][1]["hits"], 0);
    EXPECT_EQ(report["nodes"][2]["fed_by"], "rays");
    EXPECT_EQ(report["nodes"][2]["bytes"], 4096);
    EXPECT_EQ(report["vertices"][0]["hits"], 19);
    EXPECT_EQ(report["primitives"][0]["misses"], 0);
    EXPECT_EQ(report["shared"][0]["misses"], 11);
    EXPECT_EQ(report["shared"][0]["hits"], 29);
    // With lines of 4096 bytes, nodes and vertices evict each other.
    EXPECT_EQ(report["shared"][2]["misses"], 40);
}

TEST(CacheModel, countsTheSameForAnyNumberOfThreads) {
    const Scene scene = test::sceneOf(test::randomTriangles(1000, 1, 0.1f));
    const std::vector<Ray> rays = test::awkwardRays(scene, 1, 4);
    for (const FormChoice& form : forms()) {
        const EncodedBvh bvh = form.function(scene, builders()[0].function(scene, {}), {});
        const Tracer tracer(scene, bvh);
        Report reports[2];
        TraceMeasurement measured[2], unheard;
        for (const size_t threads : {1, 2}) {
            const ThreadLimit limit(threads);
            CacheModel model(parseCaches("2K:64:8"), tracer.arraySizes());
            FetchListener* const listeners[] = {&model};
            measured[threads - 1] = tracer.measure(rays, QueryKind::closest, {}, listeners);
            reports[threads - 1] = model.report(rays.size());
        }
        EXPECT_EQ(reports[0], reports[1]) << form.name;
        unheard = tracer.measure(rays, QueryKind::closest);
        EXPECT_EQ(measured[0].counts, unheard.counts) << form.name;
        EXPECT_EQ(measured[0].locality, unheard.locality) << form.name;
        // A fetch of a record touches at least one line. A triangle takes five fetches.
        const TraversalCounts& counts = measured[0].counts;
        EXPECT_GE(reports[0]["hits"].get<uint64_t>() + reports[0]["misses"].get<uint64_t>(), counts.records);
        EXPECT_EQ(reports[0]["primitives"][0]["hits"].get<uint64_t>() +
                      reports[0]["primitives"][0]["misses"].get<uint64_t>(),
                  counts.triangleTests);
    }
}

}  // namespace
}  // namespace bvhio
