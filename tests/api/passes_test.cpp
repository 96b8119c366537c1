// Passes: every method by its name, options and their errors, progress, cancellation and history.
#include <atomic>
#include <cstring>

#include "api/handles.h"

namespace apitest {
namespace {

using PassFunction = BvhioStatus (*)(const BvhioContainer*, const char* const*, const BvhioContext*,
                                     BvhioContainer**);

struct Pass {
    PassFunction run;
    const char* option;  // that names the method
    BvhioMethod methods;
};
const Pass kPasses[] = {{bvhioRestructure, "method=", BVHIO_RESTRUCTURER},
                        {bvhioRelayout, "layout=", BVHIO_LAYOUT}};

/// Runs a pass with options; expects it to succeed.
Container run(PassFunction pass, const BvhioContainer* from, std::vector<const char*> options = {},
              const BvhioContext* context = nullptr) {
    options.push_back(nullptr);
    BvhioContainer* result = nullptr;
    EXPECT_EQ(pass(from, options.data(), context, &result), BVHIO_OK) << bvhioLastError();
    return Container(result);
}

/// Hits of a few rays, for comparison.
std::vector<BvhioHit> hitsOf(const BvhioContainer* container) {
    const Tracer tracer = makeTracer(container);
    std::vector<BvhioRay> rays;
    for (int i = 0; i < 100; ++i) rays.push_back(rayDown(float(i % 10) * 0.83f, float(i / 10) * 0.79f));
    std::vector<BvhioHit> hits(rays.size());
    EXPECT_EQ(bvhioTraceClosest(tracer.get(), rays.data(), rays.size(), hits.data(), nullptr, 1), BVHIO_OK);
    return hits;
}

void expectSameHits(const BvhioContainer* a, const BvhioContainer* b) {
    const auto hitsA = hitsOf(a), hitsB = hitsOf(b);
    EXPECT_EQ(std::memcmp(hitsA.data(), hitsB.data(), hitsA.size() * sizeof(BvhioHit)), 0);
}

TEST(Methods, areListedWithSummaries) {
    for (const BvhioMethod kind :
         {BVHIO_BUILDER, BVHIO_RESTRUCTURER, BVHIO_LAYOUT, BVHIO_FORM, BVHIO_CODEC}) {
        const uint64_t count = bvhioMethodCount(kind);
        EXPECT_GE(count, 2u);
        for (uint64_t i = 0; i < count; ++i) {
            EXPECT_GT(std::strlen(bvhioMethodName(kind, i)), 1u);
            EXPECT_LT(std::strlen(bvhioMethodName(kind, i)), 20u);
            EXPECT_GT(std::strlen(bvhioMethodSummary(kind, i)), 10u);
            EXPECT_LT(std::strlen(bvhioMethodSummary(kind, i)), 120u);
        }
        EXPECT_EQ(bvhioMethodName(kind, count), nullptr);
        EXPECT_EQ(bvhioMethodSummary(kind, count), nullptr);
    }
    EXPECT_STREQ(bvhioMethodName(BVHIO_FORM, 0), "aabb");
    EXPECT_EQ(bvhioMethodCount(BvhioMethod(99)), 0u);
    EXPECT_EQ(bvhioMethodName(BvhioMethod(99), 0), nullptr);
}

TEST(Passes, everyMethodGivesTheSameHits) {
    const Scene plain = makeScene(grid(8).view()), instanced = instancedScene();
    for (const BvhioScene* scene : {plain.get(), instanced.get()}) {
        const Container first = build(scene);
        for (uint64_t i = 0; i < bvhioMethodCount(BVHIO_BUILDER); ++i) {
            const std::string option = std::string("builder=") + bvhioMethodName(BVHIO_BUILDER, i);
            expectSameHits(first.get(), build(scene, {option.c_str()}).get());
        }
        for (const Pass& pass : kPasses)
            for (uint64_t i = 0; i < bvhioMethodCount(pass.methods); ++i) {
                const std::string option = pass.option + std::string(bvhioMethodName(pass.methods, i));
                SCOPED_TRACE(option);
                expectSameHits(first.get(), run(pass.run, first.get(), {option.c_str()}).get());
            }
    }
}

TEST(Passes, leaveTheirInputAsItIs) {
    const Container first = gridContainer();
    const Bytes before = saved(first.get());
    for (const Pass& pass : kPasses) EXPECT_EQ(infoOf(run(pass.run, first.get()).get()).historyCount, 2u);
    const Bytes after = saved(first.get());
    ASSERT_EQ(before.size, after.size);
    EXPECT_EQ(std::memcmp(before.begin(), after.begin(), before.size), 0);
}

TEST(Passes, optionsTakeEffect) {
    const Scene scene = makeScene(grid(16).view());
    const Container small = build(scene.get(), {"max-leaf-size=1"}),
                    large = build(scene.get(), {"max-leaf-size=64", "builder=median"});
    BvhioTree smallTree, largeTree;
    ASSERT_EQ(bvhioGetTree(small.get(), 0, &smallTree), BVHIO_OK);
    ASSERT_EQ(bvhioGetTree(large.get(), 0, &largeTree), BVHIO_OK);
    EXPECT_EQ(smallTree.nodeCount, 1024u);
    EXPECT_LT(largeTree.nodeCount, 64u);
    EXPECT_EQ(infoOf(build(scene.get(), {"traversal-cost=2.5"}).get()).traversalCost, 2.5f);

    const Container median = build(scene.get(), {"builder=median"});
    double before = 0, after = 0;
    ASSERT_EQ(bvhioGetCost(median.get(), &before), BVHIO_OK);
    ASSERT_EQ(bvhioGetCost(run(bvhioRestructure, median.get(), {"method=tr", "iterations=2"}).get(), &after),
              BVHIO_OK);
    EXPECT_LT(after, before);
    EXPECT_EQ(bvhioGetCost(nullptr, &after), BVHIO_USAGE);
    EXPECT_EQ(bvhioGetCost(median.get(), nullptr), BVHIO_USAGE);
}

struct BadOption {
    PassFunction pass;  // NULL: bvhioBuild
    std::vector<const char*> options;
    const char* word;
};

TEST(Passes, refuseOptionsByALineThatSaysWhatIsAllowed) {
    const Scene scene = makeScene(grid(2).view());
    const Container container = build(scene.get());
    const BadOption cases[] = {
        {nullptr, {"builder"}, "'builder' is not name=value"},
        {nullptr, {"=5"}, "unknown option ''"},
        {nullptr,
         {"bilder=binned"},
         "use builder, bins, max-leaf-size, split-budget, traversal-cost or intersection-cost"},
        {nullptr, {"builder=best"}, "unknown builder 'best': use binned, sweep"},
        {nullptr, {"bins=8", "bins=9"}, "given twice"},
        {nullptr, {"bins=257"}, "'257' is not a number from 0 to 256"},
        {nullptr, {"bins=-1"}, "'-1'"},
        {nullptr, {"bins=8x"}, "'8x'"},
        {nullptr, {"bins="}, "''"},
        {nullptr, {"traversal-cost=nan"}, "'nan'"},
        {nullptr, {"builder=sweep", "bins=8"}, "builder sweep does not use it"},
        {bvhioRestructure, {"method=better"}, "use reinsertion"},
        {bvhioRestructure, {"collapse=maybe"}, "use yes or no"},
        {bvhioRestructure, {"method=none", "iterations=3"}, "method none does not use it"},
        {bvhioRestructure, {"collapse=no", "max-leaf-size=3"}, "collapse=no does not use it"},
        {bvhioRestructure, {"method=tr", "treelet-size=9999"}, "from 0 to 30"},
        {bvhioRestructure, {"builder=binned"}, "unknown option 'builder': use method"},
        {bvhioRelayout, {"layout=random"}, "use dfs"},
        {bvhioRelayout, {"layout=dfs", "line-size=128"}, "layout dfs does not use it"},
        {bvhioRelayout, {"layout=odfs", "smoothing=1"}, "probability=area does not use it"},
        {bvhioRelayout, {"layout=odfs", "probability=visits"}, "no visits"},
        {bvhioRelayout, {"layout=odfs", "probability=luck"}, "use area or visits"},
        {bvhioRelayout, {"layout=tbfs", "threshold=1.5"}, "from 0 to 1"},
    };
    for (const BadOption& bad : cases) {
        std::vector<const char*> options = bad.options;
        options.push_back(nullptr);
        BvhioContainer* result = container.get();
        EXPECT_EQ(bad.pass == nullptr ? bvhioBuild(scene.get(), options.data(), nullptr, &result)
                                      : bad.pass(container.get(), options.data(), nullptr, &result),
                  BVHIO_USAGE)
            << options[0];
        EXPECT_EQ(result, nullptr);
        EXPECT_TRUE(lastErrorHas(bad.word)) << bvhioLastError();
    }
    BvhioContainer* result = nullptr;
    EXPECT_EQ(bvhioBuild(nullptr, nullptr, nullptr, &result), BVHIO_USAGE);
    EXPECT_EQ(bvhioBuild(scene.get(), nullptr, nullptr, nullptr), BVHIO_USAGE);
    for (const Pass& pass : kPasses) {
        EXPECT_EQ(pass.run(nullptr, nullptr, nullptr, &result), BVHIO_USAGE);
        EXPECT_EQ(pass.run(container.get(), nullptr, nullptr, nullptr), BVHIO_USAGE);
    }
}

/// Counts calls, checks what they say, and cancels at one of them.
struct Watcher {
    int cancelAt = -1;
    int calls = 0;
    uint64_t last = 0;
    std::atomic<int> inside{0};

    static int hear(void* user, uint64_t done, uint64_t total) {
        auto* watcher = static_cast<Watcher*>(user);
        EXPECT_EQ(watcher->inside.fetch_add(1), 0);
        EXPECT_TRUE(done == 0 || done > watcher->last) << done;
        EXPECT_TRUE(total == 0 || done <= total) << done << " of " << total;
        watcher->last = done;
        const bool cancels = watcher->calls++ == watcher->cancelAt;
        watcher->inside.fetch_sub(1);
        return cancels ? 1 : 0;
    }
    BvhioContext context() { return {0, hear, this, nullptr, nullptr}; }
};

TEST(Progress, isReportedByEveryMethod) {
    const Scene scene = makeScene(grid(64).view());
    for (uint64_t i = 0; i < bvhioMethodCount(BVHIO_BUILDER); ++i) {
        const std::string option = std::string("builder=") + bvhioMethodName(BVHIO_BUILDER, i);
        const char* options[] = {option.c_str(), nullptr};
        Watcher watcher;
        const BvhioContext context = watcher.context();
        BvhioContainer* result = nullptr;
        ASSERT_EQ(bvhioBuild(scene.get(), options, &context, &result), BVHIO_OK) << bvhioLastError();
        bvhioClose(result);
        EXPECT_GE(watcher.calls, 2) << option;
        EXPECT_LE(watcher.calls, 1000) << option;
    }
    const Container container = build(scene.get());
    for (const Pass& pass : kPasses) {
        Watcher watcher;
        const BvhioContext context = watcher.context();
        run(pass.run, container.get(), {}, &context);
        EXPECT_GE(watcher.calls, 2) << pass.option;
    }
}

// At whichever call the caller cancels, the pass ends, nothing is made, and the next one works.
TEST(Progress, cancelsAtEveryCall) {
    const Scene scene = makeScene(grid(32).view());
    const Container container = build(scene.get());
    for (uint64_t i = 0; i < bvhioMethodCount(BVHIO_BUILDER); ++i)
        for (int at = 0; at < 12; ++at) {
            const std::string option = std::string("builder=") + bvhioMethodName(BVHIO_BUILDER, i);
            const char* options[] = {option.c_str(), nullptr};
            Watcher watcher;
            watcher.cancelAt = at;
            const BvhioContext context = watcher.context();
            BvhioContainer* result = container.get();
            const BvhioStatus status = bvhioBuild(scene.get(), options, &context, &result);
            if (status == BVHIO_OK) {
                EXPECT_LE(watcher.calls, at) << option;
                bvhioClose(result);
            } else {
                EXPECT_EQ(status, BVHIO_CANCELLED);
                EXPECT_EQ(watcher.calls, at + 1);
                EXPECT_EQ(result, nullptr);
                EXPECT_TRUE(lastErrorHas("cancelled"));
            }
        }
    for (const Pass& pass : kPasses)
        for (uint64_t i = 0; i < bvhioMethodCount(pass.methods); ++i)
            for (const int at : {0, 1, 2, 5}) {
                const std::string option = pass.option + std::string(bvhioMethodName(pass.methods, i));
                const char* options[] = {option.c_str(), nullptr};
                Watcher watcher;
                watcher.cancelAt = at;
                const BvhioContext context = watcher.context();
                BvhioContainer* result = nullptr;
                const BvhioStatus status = pass.run(container.get(), options, &context, &result);
                EXPECT_EQ(status == BVHIO_CANCELLED, watcher.calls == at + 1) << option;
                EXPECT_EQ(status == BVHIO_OK, result != nullptr);
                bvhioClose(result);
            }
    expectSameHits(container.get(), build(scene.get(), {"builder=sweep"}).get());
}

TEST(History, namesTheCallersProgramAndItsOptions) {
    const Scene scene = makeScene(grid(2).view());
    const BvhioContext named = {0, nullptr, nullptr, "my engine", "4.2"},
                       unversioned = {0, nullptr, nullptr, "bake", nullptr};
    const char* options[] = {"builder=sweep", "max-leaf-size=2", nullptr};
    BvhioContainer* result = nullptr;
    ASSERT_EQ(bvhioBuild(scene.get(), options, &named, &result), BVHIO_OK);
    const Container built(result);
    const Container changed =
        run(bvhioRestructure, run(bvhioRelayout, built.get(), {"layout=bfs"}, &unversioned).get());
    const Bytes bytes = saved(changed.get());
    BvhioContainer* handle = nullptr;
    ASSERT_EQ(bvhioOpenMemory(bytes.data.get(), bytes.size, 0, nullptr, &handle), BVHIO_OK);
    const Container opened(handle);
    ASSERT_EQ(infoOf(handle).historyCount, 3u);
    BvhioHistory history;
    ASSERT_EQ(bvhioGetHistory(handle, 0, &history), BVHIO_OK);
    EXPECT_STREQ(history.program, "my engine");
    EXPECT_STREQ(history.version, "4.2");
    const std::string recorded = history.options;
    EXPECT_EQ(recorded.substr(0, 53), "{\"pass\":\"build\",\"builder\":\"sweep\",\"bins\":0,\"max-leaf-");
    EXPECT_NE(recorded.find("\"max-leaf-size\":2"), std::string::npos);
    ASSERT_EQ(bvhioGetHistory(handle, 1, &history), BVHIO_OK);
    EXPECT_STREQ(history.program, "bake");
    EXPECT_STREQ(history.version, "");
    ASSERT_EQ(bvhioGetHistory(handle, 2, &history), BVHIO_OK);
    EXPECT_STREQ(history.program, "libbvhio");
    EXPECT_STREQ(history.version, bvhioVersionText());
    EXPECT_EQ(bvhioGetHistory(handle, 3, &history), BVHIO_USAGE);
}

TEST(Passes, resultsDoNotDependOnThreads) {
    const Scene scene = makeScene(grid(100).view());
    std::string expected;
    for (const uint32_t threads : {1u, 2u, 0u, 7u}) {
        const BvhioContext context = {threads, nullptr, nullptr, nullptr, nullptr};
        BvhioContainer* built = nullptr;
        ASSERT_EQ(bvhioBuild(scene.get(), nullptr, &context, &built), BVHIO_OK);
        const Container first(built), changed = run(bvhioRestructure, built, {"method=atr"}, &context);
        const Container last = run(bvhioRelayout, changed.get(), {"layout=pack"}, &context);
        const Bytes bytes = saved(last.get());
        const std::string text(bytes.begin(), bytes.size);
        if (expected.empty()) expected = text;
        EXPECT_TRUE(text == expected) << threads;
    }
}

}  // namespace
}  // namespace apitest
