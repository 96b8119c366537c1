// Traces one form, BVHIO_TRACED_FORM, whose Stepper is in BVHIO_STEP_HEADER. The timed loops are compiled for
// each kind of processor, and the best one is chosen at run time. foreach_target.h includes this file several
// times, so it has no guard. trace/trace_form.cpp.in shows how.
#include <hwy/highway.h>

#include BVHIO_STEP_HEADER
#include "trace/trace_form.h"
#include "trace/traverse.h"
#include "trace/triangle_blocks_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {
namespace {

template <class Query, class Result>
HWY_INLINE void traceAll(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks,
                         std::span<const Ray> rays, std::span<Result> results) {
    NoMetrics metrics;
    const Stepper<BVHIO_TRACED_FORM> stepper(form);
    for (size_t i = 0; i < rays.size(); ++i) {
        const PreparedRay ray(rays[i]);
        Query query(ray);
        if (!ray.missesByDefinition()) traverse(stepper, BlockTriangles(blocks, ray), ray, query, metrics);
        results[i] = query.result();
    }
}

void closestHits(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                 std::span<Hit> hits) {
    traceAll<ClosestHitQuery>(form, blocks, rays, hits);
}

void anyHits(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
             std::span<uint8_t> occluded) {
    traceAll<AnyHitQuery>(form, blocks, rays, occluded);
}

}  // namespace
}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "trace/trace_indexed.h"

namespace bvhio {

HWY_EXPORT(closestHits);
HWY_EXPORT(anyHits);

template <>
void closestHitsInBlocks(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks,
                         std::span<const Ray> rays, std::span<Hit> hits) {
    HWY_DYNAMIC_DISPATCH(closestHits)(form, blocks, rays, hits);
}

template <>
void anyHitsInBlocks(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded) {
    HWY_DYNAMIC_DISPATCH(anyHits)(form, blocks, rays, occluded);
}

template <>
void closestHitsIndexed(const BVHIO_TRACED_FORM& form, const Scene& scene, std::span<const Ray> rays,
                        std::span<Hit> hits) {
    HWY_NAMESPACE::traceAllIndexed<ClosestHitQuery>(form, scene, rays, hits);
}

template <>
void anyHitsIndexed(const BVHIO_TRACED_FORM& form, const Scene& scene, std::span<const Ray> rays,
                    std::span<uint8_t> occluded) {
    HWY_NAMESPACE::traceAllIndexed<AnyHitQuery>(form, scene, rays, occluded);
}

template <>
TraceMeasurement measureForm(const BVHIO_TRACED_FORM& form, const Scene& scene, std::span<const Ray> rays,
                             QueryKind query, std::span<RayCounts> perRay,
                             std::span<FetchListener* const> listeners) {
    return query == QueryKind::closest
               ? HWY_NAMESPACE::measureAll<ClosestHitQuery>(form, scene, rays, perRay, listeners)
               : HWY_NAMESPACE::measureAll<AnyHitQuery>(form, scene, rays, perRay, listeners);
}

}  // namespace bvhio
#endif
