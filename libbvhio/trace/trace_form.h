// What tracing must compile for each form: declared here, made by CMake from trace/trace_form.cpp.in.
#pragma once

#include <span>

#include "core/ray.h"
#include "metrics/fetches.h"
#include "metrics/locality.h"
#include "metrics/metrics.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

/// What is asked of rays.
enum class Query { closest, any };

/// What a run with counting found.
struct TraceMeasurement {
    TraversalCounts counts;
    LocalityCounts locality;
};

/// Trace rays through a form on this thread. Each function is specialised for each form, in a unit of its
/// own.

/// In triangle blocks, by code for the processor at hand.
template <class Form>
void closestHitsInBlocks(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits);
template <class Form>
void anyHitsInBlocks(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded);

/// In the scene's own triangles.
template <class Form>
void closestHitsIndexed(const Form& form, const Scene& scene, std::span<const Ray> rays, std::span<Hit> hits);
template <class Form>
void anyHitsIndexed(const Form& form, const Scene& scene, std::span<const Ray> rays,
                    std::span<uint8_t> occluded);

/// As Tracer::measure does, on all threads.
template <class Form>
TraceMeasurement measureForm(const Form& form, const Scene& scene, std::span<const Ray> rays, Query query,
                             std::span<RayCounts> perRay, std::span<FetchListener* const> listeners);

}  // namespace bvhio
