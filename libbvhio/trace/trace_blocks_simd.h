// The timed loops over one form, BVHIO_TRACED_FORM: compiled for each kind of processor, the best one chosen
// at run time. Included by foreach_target.h several times, so it has no guard; trace/blocks_aabb.cpp shows
// how.
#include <hwy/highway.h>

#include "trace/trace_blocks.h"
#include "trace/traverse.h"
#include "trace/traverse_two_level.h"
#include "trace/triangle_blocks_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {
namespace {

template <class Query, class Form, class Result>
HWY_INLINE void traceAll(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Result> results) {
    NoMetrics metrics;
    for (size_t i = 0; i < rays.size(); ++i) {
        const PreparedRay ray(rays[i]);
        Query query(ray);
        if (!ray.missesByDefinition()) traverse(form, BlockTriangles(blocks, ray), ray, query, metrics);
        results[i] = query.result();
    }
}

void closestHits(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                 std::span<Hit> hits) {
    traceAll<ClosestHit>(form, blocks, rays, hits);
}

void anyHits(const BVHIO_TRACED_FORM& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
             std::span<uint8_t> occluded) {
    traceAll<AnyHit>(form, blocks, rays, occluded);
}

}  // namespace
}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
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

}  // namespace bvhio
#endif
