// Compares the speed of tracing with Embree's robust mode, on one thread: closest hits of primary and diffuse
// rays through the trees of one or several chains. Runs of all of them are interleaved and medians are taken,
// so a busy machine slows all of them equally. Hits must agree with Embree's, except where t differs by less
// than 1e-5 of itself.
//
//     trace_bench [--rounds N] [--resolution N] [--intersection-cost C]
//                 [--chain BUILDER[+METHOD[:ITERATIONS]]...[@FORM[:KEY=VALUE]...]]... SCENE...
//
// Without --chain: the default builder's tree. `to first` is the rate relative to that of the first chain. If
// a chain names a form, a line reports how fast it encodes: in million nodes of the given tree per second,
// and in microseconds per triangle. Parameters are the options of bvh-compress:
//
//     trace_bench --chain binned --chain binned@quantized --chain binned@quantized-short SCENE...
//     trace_bench --chain binned@mvh:mvh-build=paper --chain binned@mvh SCENE...
//
// By default, trees are built with an intersection cost of 0.25: four triangles are tested at a time, so
// leaves of up to four cost little more than leaves of one. The default of bvh-build is 1, the field's
// convention for comparing costs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "chain.h"
#include "core/parallel.h"
#include "rays/ray_sets.h"
#include "trace/trace.h"

namespace {

using namespace bvhio;
using namespace bvhio::bench;

void embreeClosestHits(const EmbreeScene& embree, std::span<const Ray> rays, std::span<Hit> hits) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < rays.size(); ++i) {
        const Ray& r = rays[i];
        RTCRayHit ray{};
        ray.ray.org_x = r.origin.x, ray.ray.org_y = r.origin.y, ray.ray.org_z = r.origin.z;
        ray.ray.dir_x = r.direction.x, ray.ray.dir_y = r.direction.y, ray.ray.dir_z = r.direction.z;
        ray.ray.tnear = r.tMin, ray.ray.tfar = r.tMax;
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(embree.get(), &context, &ray);
        hits[i] = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID
                      ? Hit{}
                      : Hit{ray.ray.tfar, ray.hit.u, ray.hit.v, ray.hit.primID};
    }
}

struct Agreement {
    size_t differentT = 0, onlyOurs = 0, onlyEmbree = 0;
};

Agreement compareHits(std::span<const Hit> ours, std::span<const Hit> embree) {
    Agreement agreement;
    for (size_t i = 0; i < ours.size(); ++i) {
        if (ours[i].isMiss() != embree[i].isMiss())
            ++(ours[i].isMiss() ? agreement.onlyEmbree : agreement.onlyOurs);
        else if (!ours[i].isMiss() && std::abs(ours[i].t - embree[i].t) >= 1e-5f * std::abs(embree[i].t))
            ++agreement.differentT;
    }
    return agreement;
}

struct Options {
    int rounds = 5;
    uint32_t resolution = 1024;
    float intersectionCost = 0.25f;
    std::vector<std::string> chains;
    std::vector<std::filesystem::path> scenes;
};

constexpr const char* kRaySets[] = {"primary", "diffuse"};

/// Ratios over all scenes.
struct Summary {
    double logRatio = 0, logToFirst = 0, worst = 1e9;
};

/// Rates of encoding over all scenes.
struct EncodeSummary {
    double logNodes = 0, leastNodes = 1e300, mostMicroseconds = 0;
};

/// A chain's tree in one scene.
struct Contestant {
    Bvh tree;
    EncodedBvh bvh;
    Tracer tracer;
    std::vector<Hit> hits;
    std::vector<double> seconds, encodeSeconds;

    Contestant(const Chain& chain, const Scene& scene, const SahCosts& costs)
        : tree(chain.restructure(scene, chain.build(scene, costs), costs)),
          bvh(chain.encode(scene, tree)),
          tracer(scene, bvh) {}
};

/// Encodes each chain's tree again and again, those of chains that name a form in turn.
void measureEncoding(const std::vector<Chain>& chains, const Scene& scene,
                     std::vector<std::unique_ptr<Contestant>>& contestants, int rounds) {
    for (int round = 0; round < rounds; ++round)
        for (size_t i = 0; i < chains.size(); ++i)
            if (chains[i].namesForm())
                contestants[i]->encodeSeconds.push_back(
                    timeOf([&] { chains[i].encode(scene, contestants[i]->tree); }).processor);
}

void printEncoding(const std::string& sceneName, const Scene& scene, const Chain& chain, int width,
                   const Contestant& contestant, EncodeSummary& summary) {
    const double seconds = median(contestant.encodeSeconds);
    const double nodes = double(contestant.tree.nodes.size() - 1) * 1e-6 / seconds;
    const double microseconds = seconds * 1e6 / double(scene.triangles.size());
    std::printf("%-22s %-8s %-*s %9.2f M nodes/s %9.3f us/triangle\n", sceneName.c_str(), "encode", width,
                chain.name().c_str(), nodes, microseconds);
    std::fflush(stdout);
    summary.logNodes += std::log(nodes);
    summary.leastNodes = std::min(summary.leastNodes, nodes);
    summary.mostMicroseconds = std::max(summary.mostMicroseconds, microseconds);
}

void run(const Options& options, const std::vector<Chain>& chains) {
    const ThreadLimit oneThread(1);
    const EmbreeDevice device(1);
    SahCosts costs;
    costs.intersection = options.intersectionCost;
    std::vector<Summary> summaries[std::size(kRaySets)];
    for (auto& list : summaries) list.resize(chains.size());
    std::vector<EncodeSummary> encodeSummaries(chains.size());
    int width = 0;  // of the longest chain's name
    for (const Chain& chain : chains) width = std::max(width, int(chain.name().size()));
    std::printf("%-22s %-8s %-*s %9s %11s %11s %7s %9s   %s\n", "scene", "rays", width, "chain", "count",
                "ours Mr/s", "Embree Mr/s", "ratio", "to first", "other t / hit only by us / only by Embree");
    for (const auto& path : options.scenes) {
        const Scene scene = loadScene(path);
        std::vector<std::unique_ptr<Contestant>> contestants;
        for (const Chain& chain : chains)
            contestants.push_back(std::make_unique<Contestant>(chain, scene, costs));
        measureEncoding(chains, scene, contestants, options.rounds);
        for (size_t i = 0; i < chains.size(); ++i)
            if (chains[i].namesForm())
                printEncoding(path.filename(), scene, chains[i], width, *contestants[i], encodeSummaries[i]);
        EmbreeScene embree(device, scene, RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST);
        embree.commit();
        const ClosestHits closestHits = [&](std::span<const Ray> rays) {
            std::vector<Hit> hits(rays.size());
            contestants[0]->tracer.closestHits(rays, hits);
            return hits;
        };
        for (size_t set = 0; set < std::size(kRaySets); ++set) {
            RaySetOptions rayOptions;
            rayOptions.resolution = {options.resolution, options.resolution};
            const RaySet raySet = makeRaySet(kRaySets[set], scene, rayOptions, closestHits);
            const std::span<const Ray> rays = raySet.rays;
            std::vector<Hit> theirs(rays.size());
            std::vector<double> theirSeconds;
            for (auto& c : contestants) {
                c->hits.resize(rays.size());
                c->seconds.clear();
            }
            for (int round = 0; round < options.rounds; ++round) {
                for (auto& c : contestants)
                    c->seconds.push_back(timeOf([&] { c->tracer.closestHits(rays, c->hits); }).processor);
                theirSeconds.push_back(timeOf([&] { embreeClosestHits(embree, rays, theirs); }).processor);
            }
            for (size_t i = 0; i < chains.size(); ++i) {
                const double seconds = median(contestants[i]->seconds);
                const double ratio = median(theirSeconds) / seconds;
                const double toFirst = median(contestants[0]->seconds) / seconds;
                Summary& summary = summaries[set][i];
                summary.logRatio += std::log(ratio);
                summary.logToFirst += std::log(toFirst);
                summary.worst = std::min(summary.worst, ratio);
                const Agreement agreement = compareHits(contestants[i]->hits, theirs);
                const double millions = double(rays.size()) * 1e-6;
                std::printf("%-22s %-8s %-*s %9zu %11.3f %11.3f %7.3f %9.3f   %zu / %zu / %zu\n",
                            path.filename().c_str(), kRaySets[set], width, chains[i].name().c_str(),
                            rays.size(), millions / seconds, millions / median(theirSeconds), ratio, toFirst,
                            agreement.differentT, agreement.onlyOurs, agreement.onlyEmbree);
                std::fflush(stdout);
            }
        }
    }
    const auto count = double(options.scenes.size());
    for (size_t i = 0; i < chains.size(); ++i)
        if (const EncodeSummary& summary = encodeSummaries[i]; chains[i].namesForm())
            std::printf("%-8s %-*s geometric mean %.2f M nodes/s, least %.2f; at most %.3f us/triangle\n",
                        "encode", width, chains[i].name().c_str(), std::exp(summary.logNodes / count),
                        summary.leastNodes, summary.mostMicroseconds);
    for (size_t set = 0; set < std::size(kRaySets); ++set)
        for (size_t i = 0; i < chains.size(); ++i) {
            const Summary& summary = summaries[set][i];
            std::printf("%-8s %-*s geometric mean of ratios %.3f, worst %.3f; to first %.3f\n", kRaySets[set],
                        width, chains[i].name().c_str(), std::exp(summary.logRatio / count), summary.worst,
                        std::exp(summary.logToFirst / count));
        }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--rounds" && i + 1 < argc)
            options.rounds = std::max(1, std::atoi(argv[++i]));
        else if (argument == "--resolution" && i + 1 < argc)
            options.resolution = uint32_t(std::max(1, std::atoi(argv[++i])));
        else if (argument == "--intersection-cost" && i + 1 < argc)
            options.intersectionCost = std::max(0.0f, float(std::atof(argv[++i])));
        else if (argument == "--chain" && i + 1 < argc)
            options.chains.emplace_back(argv[++i]);
        else
            options.scenes.emplace_back(argument);
    }
    if (options.scenes.empty()) {
        std::fprintf(stderr,
                     "trace_bench [--rounds N] [--resolution N] [--intersection-cost C] "
                     "[--chain BUILDER[+METHOD[:ITERATIONS]]...[@FORM[:KEY=VALUE]...]]... SCENE...\n");
        return 1;
    }
    if (options.chains.empty()) options.chains.emplace_back(builders()[0].name);
    try {
        std::vector<Chain> chains;
        for (const std::string& chain : options.chains) chains.emplace_back(chain);
        run(options, chains);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "trace_bench: %s\n", error.what());
        return 1;
    }
}
