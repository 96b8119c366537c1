// Traces rays in the scene's own triangles, with or without counting. Written for each target, like
// trace/traverse.h, but compiled for one: where speed matters, rays are traced in triangle blocks. So its guard
// must not toggle: whether it then lets the one inclusion pass would depend on the number of targets.
#pragma once

#include <mutex>

#include "core/parallel.h"
#include "trace/trace_form.h"
#include "trace/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

template <class Query, class Form, class Metrics>
auto traceIndexed(const Stepper<Form>& stepper, const IndexedTriangles& triangles, const Ray& given,
                  Metrics& metrics) {
    const PreparedRay ray(given);
    Query query(ray);
    if (!ray.missesByDefinition()) traverse(stepper, triangles, ray, query, metrics);
    return query.result();
}

template <class Query, class Form, class Result>
void traceAllIndexed(const Form& form, const Scene& scene, std::span<const Ray> rays,
                     std::span<Result> results) {
    NoMetrics metrics;
    const Stepper<Form> stepper(form);
    const IndexedTriangles triangles{scene, form.primitives()};
    for (size_t i = 0; i < rays.size(); ++i)
        results[i] = traceIndexed<Query>(stepper, triangles, rays[i], metrics);
}

inline bool isHit(const Hit& hit) {
    return !hit.isMiss();
}
inline bool isHit(bool occluded) {
    return occluded;
}

template <class Query, class Form>
TraceMeasurement measureAll(const Form& form, const Scene& scene, std::span<const Ray> rays,
                            std::span<RayCounts> perRay, std::span<FetchListener* const> listeners) {
    TraversalCounts sums;
    LocalityMetrics allLocality(form.nodeBytes());
    std::mutex mutex;
    // Tasks are large, because each has its own map of touched blocks. Fetches are reported to listeners one
    // ray after another.
    const size_t raysPerTask = listeners.empty() ? 16384 : std::max(rays.size(), size_t(1));
    parallelChunks(rays.size(), raysPerTask, [&](size_t begin, size_t end) {
        CountMetrics counts;
        LocalityMetrics locality(form.nodeBytes());
        FetchMetrics fetches(listeners, scene, form.primitives());
        CombinedMetrics all(counts, locality, fetches);
        const Stepper<Form> stepper(form);
        const IndexedTriangles triangles{scene, form.primitives()};
        for (size_t i = begin; i < end; ++i) {
            fetches.beginRay(i);
            const bool hit = isHit(traceIndexed<Query>(stepper, triangles, rays[i], all));
            const RayCounts ray = counts.finishRay(hit);
            locality.finishRay();
            if (!perRay.empty()) perRay[i] = ray;
        }
        const std::lock_guard lock(mutex);
        sums.add(counts.sums());
        allLocality.add(locality);
    });
    return {sums, allLocality.counts()};
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
