// bvh-trace: traces rays through a container, counts what they cost, and times them.
#include <chrono>
#include <ctime>

#include "common/input.h"
#include "common/machine.h"
#include "common/query.h"
#include "common/run_tool.h"
#include "common/trace_options.h"
#include "common/traced_rays.h"
#include "core/parallel.h"
#include "core/report.h"
#include "metrics/fetch_table.h"
#include "pictures/heat_map.h"
#include "pictures/shaded_image.h"
#include "rays/compare.h"
#include "rays/ray_file.h"
#include "stats/size_stats.h"
#include "stats/stats_report.h"
#include "trace/simd_target.h"
#include "trace/trace_report.h"
#include "trace/visits.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-trace",
    "Traces rays through a container; counts what they cost and times them, in separate runs.",
    "  bvh-trace scene.bvhx --rays diffuse --count 1000000\n"
    "  bvh-trace scene.bvhx --resolution 1920x1080 --image scene.png --heatmap cost.png\n"
    "  bvh-trace scene.bvhx --rays random --compare other.bvhx\n",
};

/// The files beside the report. All are opened before the work starts.
struct Files {
    explicit Files(const TraceOptions& options)
        : rays(options.saveRays),
          visits(options.recordVisits),
          hits(options.hits),
          fetches(options.fetches, OutputKind::text),
          image(options.image),
          heatmap(options.heatmap) {}

    OptionalOutput rays, visits, hits, fetches, image, heatmap;
};

struct Times {
    double seconds = std::numeric_limits<double>::infinity();
    double processorSeconds = std::numeric_limits<double>::infinity();  // of all threads together
};

/// What the counting run found.
struct Counts {
    TraceMeasurement measurement;
    std::vector<uint32_t> rayCosts;  // NC + TC of each ray of the set; empty unless a heat map needs them
    Report cache;                    // null without --cache
};

Tracer tracerOf(const TraceOptions& options, const BvhxFile& file) {
    if (options.nodeStorage.empty()) return {file.scene, file.bvh};
    return {file.scene, file.bvh, choose(nodeStorages(), "node storage", options.nodeStorage)};
}

QueryKind queryOf(const TraceOptions& options) {
    return options.anyHit ? QueryKind::any : QueryKind::closest;
}

ClosestHits closestHitsOf(const Tracer& tracer) {
    return [&](std::span<const Ray> rays) {
        std::vector<Hit> hits(rays.size());
        tracer.closestHits(rays, hits);
        return hits;
    };
}

/// Returns what the rays found, in the order they were given. An any-hit query knows only that there is a
/// hit, so the hit's numbers are 0.
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

/// Returns the least times of several runs without counting.
Times fastestRun(const TraceOptions& options, const Tracer& tracer, std::span<const Ray> rays) {
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

/// Traces once more and counts. Memory reads go to the cache model and to the file of fetches.
Counts count(const TraceOptions& options, const Tracer& tracer, const OrderedRays& rays, Files& files) {
    std::vector<RayCounts> perRay(files.heatmap ? rays.traced.size() : 0);
    std::optional<CacheModel> cacheModel;
    std::optional<FetchTable> fetchTable;
    std::vector<FetchListener*> listeners;
    if (!options.caches.empty())
        listeners.push_back(&cacheModel.emplace(options.caches, tracer.arraySizes()));
    if (files.fetches) listeners.push_back(&fetchTable.emplace(files.fetches.stream(), rays.order));

    Counts counts{tracer.measure(rays.traced, queryOf(options), perRay, listeners), {}, {}};
    counts.rayCosts.resize(perRay.size());
    for (size_t i = 0; i < perRay.size(); ++i)
        counts.rayCosts[rays.order[i]] = perRay[i].boxTests + perRay[i].triangleTests;
    if (cacheModel) counts.cache = cacheModel->report(rays.traced.size());
    return counts;
}

Report timeReport(const TraceOptions& options, const Times& times, size_t rays) {
    Report report;
    report["mrays_per_second"] = times.seconds > 0 ? double(rays) / times.seconds / 1e6 : 0;
    report["threads"] = threadCount();
    report["seconds"] = times.seconds;
    report["processor_seconds"] = times.processorSeconds;
    report["cpu"] = processorName();
    if (options.nodeStorage.empty()) report["simd"] = simdTarget();
    return report;
}

void addStorage(const TraceOptions& options, const BvhxFile& file, const Tracer& tracer, Report& report) {
    SizeStats sizes = sizeStats(file.scene, file.bvh);
    if (!options.nodeStorage.empty()) sizes.nodes = tracer.arraySizes()[size_t(FetchedArray::nodes)];
    addTo(report, sizes);
    report["bytes"]["prepared"] = tracer.preparedBytes();
    report["form"] = formNameOf(file.bvh);
    if (!options.nodeStorage.empty()) report["node_storage"] = options.nodeStorage;
}

/// Compares with what the same rays find in the other container.
HitComparison compare(const TraceOptions& options, const BvhxFile& other, std::span<const Ray> rays,
                      std::span<const HitRecord> records) {
    const std::vector<HitRecord> others =
        trace(Tracer(other.scene, other.bvh), other.scene, rays, options.anyHit);
    return compareHits(records, others, {options.tolerance});
}

Report comparisonReport(const HitComparison& comparison) {
    Report report = {{"differing", comparison.differing},
                     {"hits_against_misses", comparison.hitsAgainstMisses},
                     {"max_relative_t", comparison.maxRelativeT}};
    const auto side = [](const HitRecord& hit) {
        return hit.isMiss() ? Report("miss")
                            : Report{{"t", hit.t}, {"geometry", hit.geometry}, {"primitive", hit.primitive}};
    };
    for (const HitDifference& difference : comparison.listed)
        report["first"].push_back(
            {{"ray", difference.ray}, {"here", side(difference.first)}, {"there", side(difference.second)}});
    return report;
}

/// The container with its tree in the aabb form, and how many rays visit each pair of nodes.
BvhxFile withVisits(const TraceOptions& options, const BvhxFile& file, std::span<const Ray> rays,
                    const CommandLine& line) {
    BvhxFile recorded = file;
    if (canonicalTree(file.bvh) == nullptr) {
        recorded.bvh = AabbForm(decode(file.bvh));
        dropChunksThatDoNotSurvive(recorded, Change::reordered);
    }
    recorded.visits = countVisits(file.scene, *canonicalTree(recorded.bvh), rays, queryOf(options));
    // Provenance has only the options that decide which rays these are.
    Report all = line.options(), used = Report::object();
    for (const char* name : {"rays", "count", "resolution", "seed", "camera", "any-hit"})
        used[name] = all[name];
    recorded.provenance.push_back({line.tool(), std::string(toolsVersion()), jsonText(used)});
    return recorded;
}

ExitCode traceRays(CommandLine& line) {
    TraceCommandLine given(line);
    line.suggestForExtra("--compare");
    QueryTool query(line);
    const TraceOptions& options = given.options();
    Files files(options);

    const BvhxFile file = query.read();
    if (files.visits && file.scene.isInstanced())
        throw Error(ErrorKind::usage,
                    "--record-visits: the scene has instances: build without --two-level to record visits");
    query.stages().begin("prepare");
    const Tracer tracer = tracerOf(options, file);
    const ClosestHits closestHits = closestHitsOf(tracer);
    query.stages().begin("make rays");
    const OrderedRays rays = makeRays(options, file.scene, closestHits);
    if (files.heatmap && rays.set.pixels.empty())
        throw Error(ErrorKind::usage, "--heatmap: the rays of '" + options.rays +
                                          "' do not belong to pixels: use another ray set");

    // Timed runs count nothing; the counting run is not timed.
    query.stages().begin("trace");
    const Times times = fastestRun(options, tracer, rays.traced);
    const std::vector<HitRecord> records = trace(tracer, file.scene, rays.set.rays, options.anyHit);
    query.stages().begin("count");
    const Counts counts = count(options, tracer, rays, files);

    Report report = rayReport(options, rays.set);
    report["hits"] = counts.measurement.counts.hits;
    report["hit_hash"] = hashText(hitHash(records));
    addTo(report, counts.measurement);
    if (!counts.cache.is_null()) report["cache"] = counts.cache;
    report.update(timeReport(options, times, rays.traced.size()));
    addStorage(options, file, tracer, report);
    report["camera"] = formatCamera(rays.set.camera);
    report["options"] = line.options();

    query.stages().begin("compare");
    bool different = false;
    if (!options.compare.empty()) {
        const HitComparison comparison =
            compare(options, query.readOther("--compare", options.compare), rays.set.rays, records);
        report["compare"] = comparisonReport(comparison);
        different = comparison.differing > 0;
    }

    query.stages().begin("write");
    if (files.rays) files.rays.write(encodeRays(rays.set.rays));
    if (files.visits)
        files.visits.write(
            [&](std::ostream& out) { writeBvhx(out, withVisits(options, file, rays.set.rays, line), {}); });
    if (files.hits) files.hits.write(encodeHits(records));
    if (files.fetches) files.fetches.commit();
    if (files.image)
        files.image.write(
            encodePng(shadedImage(file.scene, rays.set.camera, rays.set.resolution, closestHits)));
    if (files.heatmap)
        files.heatmap.write(encodePng(
            heatMap(costPerPixel(rays.set, counts.rayCosts), rays.set.resolution, options.heatmapScale)));
    query.print(report);
    query.finish();
    return different ? ExitCode::findings : ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, traceRays);
}
