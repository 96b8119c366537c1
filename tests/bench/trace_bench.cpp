// How fast rays are traced, against Embree's robust mode, on one thread: closest hits of primary and diffuse
// rays through the binned tree in the aabb form. Runs of both are interleaved and medians taken, so a busy
// machine hurts both alike. Hits must agree with Embree's except where t differs by less than 1e-5 of itself.
//
//     trace_bench [--rounds N] [--resolution N] [--intersection-cost C] SCENE...
//
// The trees are built with an intersection cost of 0.25 unless told otherwise: four triangles are tested at a
// time, so leaves of up to four cost little more than leaves of one. The default of bvh-build, 1, is the
// field's convention, which costs are compared by.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench_common.h"
#include "build/builders.h"
#include "core/parallel.h"
#include "trace/ray_sets.h"
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
    std::vector<std::string> scenes;
};

int run(const Options& options) {
    const ThreadLimit oneThread(1);
    const EmbreeDevice device(1);
    BuildOptions buildOptions;
    buildOptions.costs.intersection = options.intersectionCost;
    const char* const kRaySets[] = {"primary", "diffuse"};
    double logRatios[2] = {0, 0}, worst[2] = {1e9, 1e9};
    std::printf("%-22s %-8s %9s %11s %11s %7s   %s\n", "scene", "rays", "count", "ours Mr/s", "Embree Mr/s",
                "ratio", "other t / hit only by us / only by Embree");
    for (const std::string& path : options.scenes) {
        const Scene scene = loadScene(path);
        const EncodedBvh bvh = AabbForm(builders()[0].function(scene, buildOptions));
        const Tracer tracer(scene, bvh);
        EmbreeScene embree(device, scene, RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST);
        embree.commit();
        const ClosestHits closestHits = [&](std::span<const Ray> rays) {
            std::vector<Hit> hits(rays.size());
            tracer.closestHits(rays, hits);
            return hits;
        };
        for (int set = 0; set < 2; ++set) {
            RaySetOptions rayOptions;
            rayOptions.resolution = {options.resolution, options.resolution};
            const RaySet raySet = makeRaySet(kRaySets[set], scene, rayOptions, closestHits);
            const std::span<const Ray> rays = raySet.rays;
            std::vector<Hit> ours(rays.size()), theirs(rays.size());
            std::vector<double> ourSeconds, theirSeconds;
            for (int round = 0; round < options.rounds; ++round) {
                ourSeconds.push_back(timeOf([&] { tracer.closestHits(rays, ours); }).processor);
                theirSeconds.push_back(timeOf([&] { embreeClosestHits(embree, rays, theirs); }).processor);
            }
            const double ratio = median(theirSeconds) / median(ourSeconds);
            logRatios[set] += std::log(ratio);
            worst[set] = std::min(worst[set], ratio);
            const Agreement agreement = compareHits(ours, theirs);
            const double millions = double(rays.size()) * 1e-6;
            const std::string name = path.substr(path.rfind('/') + 1);
            std::printf("%-22s %-8s %9zu %11.3f %11.3f %7.3f   %zu / %zu / %zu\n", name.c_str(),
                        kRaySets[set], rays.size(), millions / median(ourSeconds),
                        millions / median(theirSeconds), ratio, agreement.differentT, agreement.onlyOurs,
                        agreement.onlyEmbree);
        }
    }
    for (int set = 0; set < 2; ++set)
        std::printf("%-8s geometric mean of ratios %.3f, worst %.3f\n", kRaySets[set],
                    std::exp(logRatios[set] / double(options.scenes.size())), worst[set]);
    return 0;
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
        else
            options.scenes.push_back(argument);
    }
    if (options.scenes.empty()) {
        std::fprintf(stderr, "trace_bench [--rounds N] [--resolution N] [--intersection-cost C] SCENE...\n");
        return 1;
    }
    try {
        return run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "trace_bench: %s\n", error.what());
        return 1;
    }
}
