// Building: our default builder against Embree's medium quality, interleaved.
// Usage: build_bench [--rounds N] [--threads N] SCENE...

#include "bench_common.h"
#include "build/builders.h"
#include "core/parallel.h"

namespace {

using namespace bvhio;
using namespace bvhio::bench;

void measure(const std::filesystem::path& path, int rounds, const EmbreeDevice& device, const Table& table) {
    const Scene scene = loadScene(path);
    const Builder& builder = builders().front();
    double unitCost = 0, defaultCost = 0;
    {
        BuildOptions unit;
        unit.costs = {1, 1};
        unitCost = sahCost(builder.function(scene, unit), unit.costs);
        defaultCost = sahCost(builder.function(scene, {}), {});
    }
    Samples ours, embrees;
    for (int round = 0; round < rounds; ++round) {
        {
            Bvh bvh;
            ours.add(timeOf([&] { bvh = builder.function(scene, {}); }));
        }
        EmbreeScene embree(device, scene);
        embrees.add(timeOf([&] { embree.commit(); }));
    }
    table.row({path.filename().string(), std::to_string(scene.triangles.size()),
               number(ours.medianWall() * 1e3, 1), number(embrees.medianWall() * 1e3, 1),
               number(ours.medianWall() / embrees.medianWall(), 2),
               number(ours.medianProcessor() / embrees.medianProcessor(), 2), number(unitCost, 2),
               number(defaultCost, 2)});
}

}  // namespace

int main(int count, char** arguments) {
    const Arguments options(count, arguments);
    if (options.scenes.empty()) {
        std::fprintf(stderr, "usage: build_bench [--rounds N] [--threads N] SCENE...\n");
        return 1;
    }
    try {
        const ThreadLimit limit(options.threads);
        const EmbreeDevice device(options.threads);
        const Table table(
            {"scene", "triangles", "ms", "embree ms", "ratio", "cpu ratio", "cost 1/1", "cost 1.2/1"});
        for (const auto& path : options.scenes) measure(path, options.rounds, device, table);
    } catch (const Error& error) {
        std::fprintf(stderr, "build_bench: %s\n", error.what());
        return int(error.kind());
    }
}
