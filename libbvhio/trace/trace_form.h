// The functions that tracing compiles for each form, by files that CMake makes from trace/trace_form.cpp.in.
#pragma once

#include <span>

#include "core/ray.h"
#include "metrics/fetches.h"
#include "metrics/locality.h"
#include "metrics/metrics.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

/// The kinds of queries.
enum class QueryKind { closest, any };

/// The counts of a run.
struct TraceMeasurement {
    TraversalCounts counts;
    LocalityCounts locality;
};

/// These functions trace rays through a form on this thread. Each function is specialised for each form, in a
/// file of its own.

/// These trace in triangle blocks, by code for the current processor.
template <class Form>
void closestHitsInBlocks(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits);
template <class Form>
void anyHitsInBlocks(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded);

/// These trace in the scene's own triangles.
template <class Form>
void closestHitsIndexed(const Form& form, const Scene& scene, std::span<const Ray> rays, std::span<Hit> hits);
template <class Form>
void anyHitsIndexed(const Form& form, const Scene& scene, std::span<const Ray> rays,
                    std::span<uint8_t> occluded);

/// Does the work of Tracer::measure, on all threads.
template <class Form>
TraceMeasurement measureForm(const Form& form, const Scene& scene, std::span<const Ray> rays, QueryKind query,
                             std::span<RayCounts> perRay, std::span<FetchListener* const> listeners);

}  // namespace bvhio
