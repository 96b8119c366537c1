#include "common/traced_rays.h"

#include "common/input.h"
#include "rays/find_camera.h"
#include "rays/ray_file.h"
#include "rays/ray_order.h"

namespace bvhio {
namespace {

RaySet raySetOf(const TraceOptions& options, const Scene& scene, const ClosestHits& closestHits) {
    for (const auto& row : raySets())
        if (row.name == options.rays) return makeRaySet(options.rays, scene, options.set, closestHits);
    RaySet set;
    set.rays = decodeRays(readWholeFile(options.rays), options.rays);
    set.resolution = options.set.resolution;
    const double aspect = double(set.resolution.width) / set.resolution.height;
    set.camera = options.set.camera ? *options.set.camera : findCamera(scene, aspect, closestHits);
    return set;
}

}  // namespace

OrderedRays makeRays(const TraceOptions& options, const Scene& scene, const ClosestHits& closestHits) {
    OrderedRays rays{raySetOf(options, scene, closestHits), {}, {}};
    rays.order = choose(rayOrders(), "ray order", options.rayOrder).function(rays.set.rays, options.set.seed);
    rays.traced.reserve(rays.order.size());
    for (const uint32_t ray : rays.order) rays.traced.push_back(rays.set.rays[ray]);
    return rays;
}

Report rayReport(const TraceOptions& options, const RaySet& set) {
    Report report = {{"rays", set.rays.size()}};
    if (set.pixels.empty()) return report;
    if (options.set.count > 0) report["rays_at_most"] = options.set.count;
    report["resolution"] = formatResolution(set.resolution);
    return report;
}

}  // namespace bvhio
