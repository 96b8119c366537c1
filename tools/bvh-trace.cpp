// bvh-trace: shoots rays through a container, and counts and times what they cost.
#include <chrono>
#include <ctime>

#include "common/input.h"
#include "common/query.h"
#include "common/run_tool.h"
#include "core/parallel.h"
#include "metrics/cache_model.h"
#include "metrics/fetch_table.h"
#include "pictures/heat_map.h"
#include "pictures/shaded_image.h"
#include "rays/compare.h"
#include "rays/find_camera.h"
#include "rays/ray_file.h"
#include "rays/ray_order.h"
#include "rays/ray_sets.h"
#include "stats/size_stats.h"
#include "stats/stats_report.h"
#include "trace/trace_report.h"
#include "trace/visits.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-trace",
    "Shoots rays through a container; counts what they cost and times them, in runs apart.",
    "  bvh-trace scene.bvhx --rays diffuse --count 1000000\n"
    "  bvh-trace scene.bvhx --resolution 1920x1080 --image scene.png --heatmap cost.png\n"
    "  bvh-trace scene.bvhx --rays random --compare other.bvhx\n",
};

struct Options {
    std::string rays, rayOrder, nodeStorage, resolution, camera, cache, fetches, saveRays, recordVisits, hits,
        image, heatmap, compare;
    RaySetOptions set;
    bool anyHit = false;
    uint32_t repeat = 3, heatmapScale = 0;
    float tolerance = 0;
};

void declare(CommandLine& line, Options& options) {
    options.rays = raySets()[0].name;
    options.rayOrder = rayOrders()[0].name;
    options.resolution =
        std::to_string(options.set.resolution.width) + "x" + std::to_string(options.set.resolution.height);
    line.choiceOrFile("--rays", options.rays, namedValues(raySets()), "FILE.rays", "which rays");
    line.number("--count", options.set.count, 1, kMaxRays,
                "at most so many rays; none: as --resolution says");
    line.text("--resolution", "WxH", options.resolution, "pixels of the picture that rays start from");
    line.number("--seed", options.set.seed, 0, UINT64_MAX, "of rays that are random");
    line.text("--camera", "EYE:TARGET[:FOV[:UP]]", options.camera,
              "points as x,y,z; none: found from the scene");
    line.flag("--any-hit", options.anyHit, "ask for any hit, not the closest");
    line.choice("--ray-order", options.rayOrder, namedValues(rayOrders()),
                "the order in which rays are traced");
    line.choice("--node-storage", options.nodeStorage, namedValues(nodeStorages()),
                "store the aabb form's nodes so, to compare");
    line.list("--cache", "SIZE:LINE:WAYS", options.cache,
              "model a cache; levels by commas or again; + for another");
    line.number("--repeat", options.repeat, 1, 1000, "timed runs, of which the fastest counts");
    line.text("--compare", "OTHER.bvhx", options.compare, "trace this too; exit 7 when hits differ");
    line.number("--tolerance", options.tolerance, 0, 1, "t may differ by this part of it, in --compare");
    line.text("--fetches", "FILE.csv", options.fetches, "write where each read begins, in which array");
    line.text("--save-rays", "FILE.rays", options.saveRays, "write the rays");
    line.text("--record-visits", "FILE.bvhx", options.recordVisits,
              "write the container with how many rays visit each pair of nodes");
    line.text("--hits", "FILE.hits", options.hits, "write the hits");
    line.text("--image", "FILE.png", options.image, "draw the scene, shaded");
    line.text("--heatmap", "FILE.png", options.heatmap, "draw what each pixel's rays cost: NC + TC");
    line.number("--heatmap-scale", options.heatmapScale, 1, 1000000000,
                "tests per ray drawn as white; none: found from the picture");
}

Tracer tracerOf(const Options& options, const BvhxFile& file) {
    if (options.nodeStorage.empty()) return {file.scene, file.bvh};
    return {file.scene, file.bvh, choose(nodeStorages(), "node storage", options.nodeStorage)};
}

/// Reads a ray file, or makes a set of the table.
RaySet raysOf(const Options& options, const Scene& scene, const ClosestHits& closestHits) {
    for (const auto& row : raySets())
        if (row.name == options.rays) return makeRaySet(options.rays, scene, options.set, closestHits);
    RaySet set;
    set.rays = decodeRays(readWholeFile(options.rays), options.rays);
    set.resolution = options.set.resolution;
    const double aspect = double(set.resolution.width) / set.resolution.height;
    set.camera = options.set.camera ? *options.set.camera : findCamera(scene, aspect, closestHits);
    return set;
}

/// What the traced rays found, in the order they were given. An any-hit query tells only that there is a hit:
/// its numbers are 0.
std::vector<HitRecord> trace(const Tracer& tracer, const Scene& scene, std::span<const Ray> rays,
                             bool anyHit) {
    if (!anyHit) {
        std::vector<Hit> hits(rays.size());
        tracer.closestHits(rays, hits);
        return hitRecords(scene, hits);
    }
    std::vector<uint8_t> occluded(rays.size());
    tracer.anyHits(rays, occluded);
    std::vector<HitRecord> records(rays.size());
    for (size_t i = 0; i < rays.size(); ++i)
        if (occluded[i]) records[i] = {0, 0, 0, 0, 0, 0};
    return records;
}

struct Times {
    double seconds = std::numeric_limits<double>::infinity();
    double processorSeconds = std::numeric_limits<double>::infinity();  // of all threads together
};

/// The least times of several runs without counting.
Times fastestRun(const Tracer& tracer, std::span<const Ray> rays, const Options& options) {
    std::vector<Hit> hits(options.anyHit ? 0 : rays.size());
    std::vector<uint8_t> occluded(options.anyHit ? rays.size() : 0);
    Times best;
    for (uint32_t i = 0; i < options.repeat; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t processorStart = std::clock();
        options.anyHit ? tracer.anyHits(rays, occluded) : tracer.closestHits(rays, hits);
        const double processorSeconds = double(std::clock() - processorStart) / CLOCKS_PER_SEC;
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = {std::min(best.seconds, seconds), std::min(best.processorSeconds, processorSeconds)};
    }
    return best;
}

/// Compares with what the other container's rays found; prints how they differ.
bool differs(const Options& options, const BvhxFile& other, std::span<const Ray> rays,
             std::span<const HitRecord> records, Report& report) {
    const std::vector<HitRecord> others =
        trace(Tracer(other.scene, other.bvh), other.scene, rays, options.anyHit);
    const HitComparison comparison = compareHits(records, others, {options.tolerance});
    report["compare"] = {{"differing", comparison.differing},
                         {"hits_against_misses", comparison.hitsAgainstMisses},
                         {"max_relative_t", comparison.maxRelativeT}};
    const auto side = [](const HitRecord& hit) {
        return hit.isMiss() ? Report("miss")
                            : Report{{"t", hit.t}, {"geometry", hit.geometry}, {"primitive", hit.primitive}};
    };
    for (const HitDifference& difference : comparison.listed)
        report["compare"]["first"].push_back(
            {{"ray", difference.ray}, {"here", side(difference.first)}, {"there", side(difference.second)}});
    return comparison.differing > 0;
}

/// The container with its tree in the aabb form, and the visits of its pairs.
BvhxFile withVisits(const BvhxFile& file, std::span<const Ray> rays, const CommandLine& line, bool anyHit) {
    BvhxFile recorded = file;
    if (!std::holds_alternative<AabbForm>(file.bvh)) {
        recorded.bvh = AabbForm(decode(file.bvh));
        dropChunksThatDoNotSurvive(recorded, Change::reordered);
    }
    recorded.visits = countVisits(file.scene, std::get<AabbForm>(recorded.bvh).bvh(), rays,
                                  anyHit ? QueryKind::any : QueryKind::closest);
    // What else was asked for leaves no trace in the file.
    Report all = line.options(), options = Report::object();
    for (const char* name : {"rays", "count", "resolution", "seed", "camera", "any-hit"})
        options[name] = all[name];
    recorded.provenance.push_back({line.tool(), std::string(toolsVersion()), jsonText(options)});
    return recorded;
}

ExitCode traceRays(CommandLine& line) {
    Options options;
    declare(line, options);
    QueryTool query(line);
    options.set.resolution = parseResolution(options.resolution);
    if (!options.camera.empty()) options.set.camera = parseCamera(options.camera);
    const std::vector<CacheLevels> caches =
        options.cache.empty() ? std::vector<CacheLevels>() : parseCaches(options.cache);
    OptionalOutput raysOutput(options.saveRays), visitsOutput(options.recordVisits), hitsOutput(options.hits),
        fetchesOutput(options.fetches, OutputKind::text), image(options.image), heatmap(options.heatmap);
    if (line.isGiven("--heatmap-scale") && !heatmap)
        throw Error(ErrorKind::usage, "--heatmap-scale: there is no heat map: give --heatmap as well");

    const BvhxFile file = query.read();
    if (visitsOutput && file.scene.isInstanced())
        throw Error(ErrorKind::usage,
                    "--record-visits: the scene has instances: build without --two-level to record visits");
    query.stages().begin("prepare");
    const Tracer tracer = tracerOf(options, file);
    const ClosestHits closestHits = [&](std::span<const Ray> rays) {
        std::vector<Hit> hits(rays.size());
        tracer.closestHits(rays, hits);
        return hits;
    };
    query.stages().begin("make rays");
    const RaySet set = raysOf(options, file.scene, closestHits);
    if (heatmap && set.pixels.empty())
        throw Error(ErrorKind::usage,
                    "--heatmap: the rays of '" + options.rays + "' belong to no pixel: use another set");
    const auto order =
        choose(rayOrders(), "ray order", options.rayOrder).function(set.rays, options.set.seed);
    std::vector<Ray> rays(set.rays.size());
    for (size_t i = 0; i < rays.size(); ++i) rays[i] = set.rays[order[i]];

    query.stages().begin("trace");
    const Times times = fastestRun(tracer, rays, options);
    const std::vector<HitRecord> records = trace(tracer, file.scene, set.rays, options.anyHit);
    query.stages().begin("count");
    std::vector<RayCounts> perRay(heatmap ? rays.size() : 0);
    std::optional<CacheModel> cacheModel;
    std::optional<FetchTable> fetchTable;
    std::vector<FetchListener*> listeners;
    if (!caches.empty()) listeners.push_back(&cacheModel.emplace(caches, tracer.arraySizes()));
    if (fetchesOutput) listeners.push_back(&fetchTable.emplace(fetchesOutput.stream(), order));
    const TraceMeasurement measurement =
        tracer.measure(rays, options.anyHit ? QueryKind::any : QueryKind::closest, perRay, listeners);

    Report report = {{"rays", rays.size()}, {"hits", measurement.counts.hits}};
    report["hit_hash"] = hashText(hitHash(records));
    addTo(report, measurement);
    if (cacheModel) report["cache"] = cacheModel->report(rays.size());
    report["mrays_per_second"] = times.seconds > 0 ? double(rays.size()) / times.seconds / 1e6 : 0;
    report["threads"] = threadCount();
    report["seconds"] = times.seconds;
    report["processor_seconds"] = times.processorSeconds;
    SizeStats sizes = sizeStats(file.scene, file.bvh);
    if (!options.nodeStorage.empty()) sizes.nodes = tracer.arraySizes()[size_t(FetchedArray::nodes)];
    addTo(report, sizes);
    report["bytes"]["prepared"] = tracer.preparedBytes();
    report["form"] = formNameOf(file.bvh);
    if (!options.nodeStorage.empty()) report["node_storage"] = options.nodeStorage;
    report["camera"] = formatCamera(set.camera);
    report["options"] = line.options();
    query.stages().begin("compare");
    const bool different =
        !options.compare.empty() &&
        differs(options, query.readOther("--compare", options.compare), set.rays, records, report);

    query.stages().begin("write");
    if (raysOutput) raysOutput.write(encodeRays(set.rays));
    if (visitsOutput)
        visitsOutput.write(
            [&](std::ostream& out) { writeBvhx(out, withVisits(file, set.rays, line, options.anyHit), {}); });
    if (hitsOutput) hitsOutput.write(encodeHits(records));
    if (fetchesOutput) fetchesOutput.commit();
    if (image) image.write(encodePng(shadedImage(file.scene, set.camera, set.resolution, closestHits)));
    if (heatmap) {
        std::vector<uint32_t> costs(rays.size());
        for (size_t i = 0; i < rays.size(); ++i)
            costs[order[i]] = perRay[i].boxTests + perRay[i].triangleTests;
        heatmap.write(encodePng(heatMap(costPerPixel(set, costs), set.resolution, options.heatmapScale)));
    }
    query.print(report);
    query.finish();
    return different ? ExitCode::findings : ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, traceRays);
}
