// Eight threads use the API at once: one tracer, one container whose trees are decoded on demand, and
// containers of their own. Built with -fsanitize=thread (preset tsan) it shows that nothing races; here, that
// results agree.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "api/bvhio.h"

namespace {

constexpr int kThreads = 8, kRounds = 50;

std::atomic<int> failures{0};

void expect(bool condition, const char* what) {
    if (condition) return;
    std::printf("%s: %s\n", what, bvhioLastError());
    ++failures;
}

BvhioContainer* buildGrid(uint32_t side) {
    std::vector<float> vertices;
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            vertices.insert(vertices.end(), {float(x), float(y), std::sin(float(x * 3 + y * 5))});
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x, b = a + side + 1;
            indices.insert(indices.end(), {a, a + 1, b, a + 1, b + 1, b});
        }
    BvhioSceneArrays arrays{};
    arrays.vertices = vertices.data();
    arrays.vertexCount = vertices.size() / 3;
    arrays.indices = indices.data();
    arrays.triangleCount = indices.size() / 3;
    BvhioScene* scene = nullptr;
    BvhioContainer* container = nullptr;
    const BvhioContext one = {1, nullptr, nullptr, nullptr, nullptr};
    expect(bvhioCreateScene(&arrays, &scene) == BVHIO_OK, "create scene");
    expect(bvhioBuild(scene, nullptr, &one, &container) == BVHIO_OK, "build");
    bvhioDestroyScene(scene);
    return container;
}

BvhioRay rayAt(int i) {
    return {{float(i % 37) * 0.31f, float(i % 41) * 0.29f, 9}, 0, {0.1f, 0.05f, -1}, INFINITY};
}

struct Shared {
    const BvhioContainer* container;
    const BvhioTracer* tracer;
    const void* bytes;
    size_t size;
    std::vector<BvhioHit> expected;
};

void work(const Shared& shared, int thread) {
    const BvhioContext one = {1, nullptr, nullptr, nullptr, nullptr};
    std::vector<BvhioRay> rays;
    for (size_t i = 0; i < shared.expected.size(); ++i) rays.push_back(rayAt(int(i)));
    for (int round = 0; round < kRounds; ++round) {
        // One tracer for all, ray by ray and in batches.
        for (size_t i = size_t(thread); i < rays.size(); i += 7) {
            BvhioHit hit;
            bvhioTraceRay(shared.tracer, &rays[i], &hit, nullptr);
            expect(std::memcmp(&hit, &shared.expected[i], sizeof hit) == 0, "ray");
        }
        std::vector<BvhioHit> hits(rays.size());
        expect(
            bvhioTraceClosest(shared.tracer, rays.data(), rays.size(), hits.data(), nullptr, 1) == BVHIO_OK,
            "batch");
        expect(std::memcmp(hits.data(), shared.expected.data(), hits.size() * sizeof(BvhioHit)) == 0, "hits");
        BvhioTree tree;
        expect(bvhioGetTree(shared.container, 0, &tree) == BVHIO_OK && tree.nodeCount > 2, "tree");

        // A container of this thread's own, from the same bytes.
        BvhioContainer *opened = nullptr, *changed = nullptr;
        BvhioTracer* tracer = nullptr;
        expect(bvhioOpenMemory(shared.bytes, shared.size, round % 2 == 0 ? 0 : BVHIO_TRUSTED, &one,
                               &opened) == BVHIO_OK,
               "open");
        expect(bvhioCreateTracer(opened, 0, &one, &tracer) == BVHIO_OK, "tracer");
        expect(bvhioIsOccluded(tracer, &rays[0]) == (shared.expected[0].geometry != BVHIO_NOTHING),
               "occluded");
        expect(bvhioRelayout(opened, nullptr, &one, &changed) == BVHIO_OK, "relayout");
        bvhioClose(opened);
        bvhioClose(changed);
        bvhioDestroyTracer(tracer);

        // Errors belong to the thread.
        char path[32];
        std::snprintf(path, sizeof path, "/no/such/file%d", thread);
        expect(bvhioOpenFile(path, 0, &one, &opened) == BVHIO_IO, "missing");
        expect(std::strstr(bvhioLastError(), path) != nullptr, "last error");
    }
}

}  // namespace

int main() {
    BvhioContainer* built = buildGrid(12);
    void* bytes = nullptr;
    size_t size = 0;
    expect(bvhioSaveMemory(built, nullptr, &bytes, &size) == BVHIO_OK, "save");
    BvhioContainer* container = nullptr;
    BvhioTracer* tracer = nullptr;
    expect(bvhioOpenMemory(bytes, size, 0, nullptr, &container) == BVHIO_OK, "open");
    expect(bvhioCreateTracer(container, 0, nullptr, &tracer) == BVHIO_OK, "tracer");
    Shared shared{container, tracer, bytes, size, {}};
    for (int i = 0; i < 300; ++i) {
        const BvhioRay ray = rayAt(i);
        shared.expected.emplace_back();
        bvhioTraceRay(tracer, &ray, &shared.expected.back(), nullptr);
    }
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) threads.emplace_back([&, i] { work(shared, i); });
    for (std::thread& thread : threads) thread.join();
    bvhioDestroyTracer(tracer);
    bvhioClose(container);
    bvhioClose(built);
    bvhioFree(bytes);
    return failures == 0 ? 0 : 1;
}
