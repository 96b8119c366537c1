#include "common/trace_options.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/error.h"
#include "rays/ray_order.h"
#include "trace/node_storage.h"

namespace bvhio {
namespace {

/// Refuses a file name that promises another kind of picture. A name without a suffix promises nothing.
void requirePng(const char* option, const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (!suffix.empty() && suffix != ".png")
        throw Error(ErrorKind::usage, std::string(option) + ": " + path +
                                          ": pictures are written as PNG only: use a name that ends in .png");
}

}  // namespace

TraceCommandLine::TraceCommandLine(CommandLine& line) {
    TraceOptions& options = options_;
    options.rays = raySets()[0].name;
    options.rayOrder = rayOrders()[0].name;
    resolution_ = formatResolution(options.set.resolution);
    line.choiceOrFile("--rays", options.rays, namedValues(raySets()), "FILE.rays",
                      "set of rays, or a file of rays");
    line.number("--count", options.set.count, 1, kMaxRays,
                "most rays: random traces exactly N; the other sets trace the largest 4:3 picture that makes "
                "at most N rays (default: by --resolution)");
    line.text("--resolution", "WxH", resolution_, "pixels of the picture; not used with --count");
    line.number("--seed", options.set.seed, 0, UINT64_MAX, "seed of random rays");
    line.text("--camera", "EYE:TARGET[:FOV[:UP]]", camera_,
              "camera: points as x,y,z, vertical angle in degrees (default: found from the scene)");
    line.flag("--any-hit", options.anyHit, "find any hit, not the closest one");
    line.choice("--ray-order", options.rayOrder, namedValues(rayOrders()), "order in which rays are traced");
    line.choice("--node-storage", options.nodeStorage, namedValues(nodeStorages()),
                "other storage of the aabb form's nodes in memory, for comparisons");
    line.list("--cache", "SIZE:LINE:WAYS", cache_,
              "simulated cache, as in 32K:64:8; next level after a comma, another cache after a +");
    line.number("--repeat", options.repeat, 1, 1000, "timed runs; the fastest one is reported");
    line.text("--compare", "OTHER.bvhx", options.compare,
              "container to trace too; exit code 7 when hits differ");
    line.number("--tolerance", options.tolerance, 0, 1,
                "relative difference of t that --compare accepts; 0: none");
    line.text("--fetches", "FILE.csv", options.fetches, "file for every memory read: array, offset, size");
    line.text("--save-rays", "FILE.rays", options.saveRays, "file for the rays");
    line.text("--record-visits", "FILE.bvhx", options.recordVisits,
              "file for the container with the number of rays that visit each pair of nodes");
    line.text("--hits", "FILE.hits", options.hits, "file for the hits");
    line.text("--image", "FILE.png", options.image, "file for a shaded picture of the scene");
    line.text("--heatmap", "FILE.png", options.heatmap, "file for a picture of the cost per pixel, NC + TC");
    line.number("--heatmap-scale", options.heatmapScale, 1, 1000000000,
                "tests per ray that --heatmap draws as white (default: found from the picture)");
}

const TraceOptions& TraceCommandLine::options() {
    requirePng("--image", options_.image);
    requirePng("--heatmap", options_.heatmap);
    if (options_.heatmapScale > 0 && options_.heatmap.empty())
        throw Error(ErrorKind::usage, "--heatmap-scale: there is no heat map: give --heatmap as well");
    options_.set.resolution = parseResolution(resolution_);
    if (!camera_.empty()) options_.set.camera = parseCamera(camera_);
    if (!cache_.empty()) options_.caches = parseCaches(cache_);
    return options_;
}

}  // namespace bvhio
