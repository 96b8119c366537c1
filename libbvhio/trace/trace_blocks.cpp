// The timed loops: compiled for each kind of processor, the best one chosen at run time.
#include "trace/trace_blocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/trace_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/traverse.h"
#include "trace/triangle_blocks_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {
namespace {

template <class Query, class Form, class Result>
HWY_INLINE void traceAll(const Form& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         Result* results) {
    NoMetrics metrics;
    for (size_t i = 0; i < rays.size(); ++i) {
        const PreparedRay ray(rays[i]);
        Query query(ray);
        if (!ray.missesByDefinition()) traverse(form, BlockTriangles(blocks, ray), ray, query, metrics);
        results[i] = query.result();
    }
}

void closestHits(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays, Hit* hits) {
    std::visit([&](const auto& form) { traceAll<ClosestHit>(form, blocks, rays, hits); }, bvh);
}

void anyHits(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays,
             uint8_t* occluded) {
    std::visit([&](const auto& form) { traceAll<AnyHit>(form, blocks, rays, occluded); }, bvh);
}

}  // namespace
}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(closestHits);
HWY_EXPORT(anyHits);

void closestHitsInBlocks(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits) {
    HWY_DYNAMIC_DISPATCH(closestHits)(bvh, blocks, rays, hits.data());
}

void anyHitsInBlocks(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded) {
    HWY_DYNAMIC_DISPATCH(anyHits)(bvh, blocks, rays, occluded.data());
}

}  // namespace bvhio
#endif
