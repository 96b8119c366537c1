// Times building and restructuring: our chains and Embree's three qualities, interleaved in each round.
// Usage: build_bench [--rounds N] [--threads N] [--chain BUILDER[+METHOD[:ITERATIONS]]]... SCENE...
// Without --chain: every builder, then every restructurer after the default builder. Times are medians of the
// whole chain, and `restructure` is the restructurers' part of it. Costs are for SAH parameters 1 and 1, as
// papers report them, and trees are built for these too.

#include "chain.h"
#include "core/parallel.h"

namespace {

using namespace bvhio;
using namespace bvhio::bench;

std::vector<Chain> allChains() {
    std::vector<Chain> chains;
    for (const Builder& builder : builders()) chains.emplace_back(std::string(builder.name));
    for (const Restructurer& restructurer : restructurers())
        chains.emplace_back(std::string(builders()[0].name) + "+" + std::string(restructurer.name));
    return chains;
}

struct Measured {
    Samples build, restructure;
    double cost = 0, references = 0;
};

void run(const Chain& chain, const Scene& scene, Measured& measured) {
    constexpr SahCosts kCosts{1, 1};
    Bvh bvh;
    measured.build.add(timeOf([&] { bvh = chain.build(scene, kCosts); }));
    measured.restructure.add(timeOf([&] { bvh = chain.restructure(scene, std::move(bvh), kCosts); }));
    measured.cost = sahCost(bvh, kCosts);
    measured.references = double(bvh.primitives.size()) / double(scene.triangles.size());
}

struct EmbreeQuality {
    const char* name;
    RTCBuildQuality quality;
};
constexpr EmbreeQuality kEmbree[] = {{"embree low", RTC_BUILD_QUALITY_LOW},
                                     {"embree medium", RTC_BUILD_QUALITY_MEDIUM},
                                     {"embree high", RTC_BUILD_QUALITY_HIGH}};

void measure(const std::filesystem::path& path, int rounds, const std::vector<Chain>& chains,
             const EmbreeDevice& device) {
    const Scene scene = loadScene(path);
    std::printf("%s, %zu triangles\n", path.filename().c_str(), scene.triangles.size());
    std::vector<Measured> ours(chains.size());
    Samples embrees[std::size(kEmbree)];
    for (int round = 0; round < rounds; ++round) {
        for (size_t i = 0; i < chains.size(); ++i) run(chains[i], scene, ours[i]);
        for (size_t i = 0; i < std::size(kEmbree); ++i) {
            EmbreeScene embree(device, scene, kEmbree[i].quality);
            embrees[i].add(timeOf([&] { embree.commit(); }));
        }
    }

    const double medium = embrees[1].medianWall();
    const Table table({"chain", "ms", "restructure", "to medium", "cpu ms", "cost 1/1", "references"});
    for (size_t i = 0; i < chains.size(); ++i) {
        const Measured& m = ours[i];
        const double total = m.build.medianWall() + m.restructure.medianWall();
        table.row({chains[i].name(), number(total * 1e3, 1), number(m.restructure.medianWall() * 1e3, 1),
                   number(total / medium, 2),
                   number((m.build.medianProcessor() + m.restructure.medianProcessor()) * 1e3, 1),
                   number(m.cost, 2), number(m.references, 3)});
    }
    for (size_t i = 0; i < std::size(kEmbree); ++i)
        table.row({kEmbree[i].name, number(embrees[i].medianWall() * 1e3, 1), "",
                   number(embrees[i].medianWall() / medium, 2),
                   number(embrees[i].medianProcessor() * 1e3, 1)});
    std::printf("\n");
}

}  // namespace

int main(int count, char** arguments) {
    try {
        std::vector<std::string> chainNames;
        const Arguments options(count, arguments, "--chain", &chainNames);
        if (options.scenes.empty()) {
            std::fprintf(stderr,
                         "usage: build_bench [--rounds N] [--threads N] "
                         "[--chain BUILDER[+METHOD[:ITERATIONS]]]... SCENE...\n");
            return 1;
        }
        std::vector<Chain> chains;
        for (const std::string& name : chainNames) chains.emplace_back(name);
        if (chains.empty()) chains = allChains();
        const ThreadLimit limit(options.threads);
        const EmbreeDevice device(options.threads);
        for (const auto& path : options.scenes) measure(path, options.rounds, chains, device);
    } catch (const Error& error) {
        std::fprintf(stderr, "build_bench: %s\n", error.what());
        return int(error.kind());
    }
}
