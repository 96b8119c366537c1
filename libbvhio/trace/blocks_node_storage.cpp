// Tracing nodes stored in other ways in triangle blocks. Compiled once, for every processor: what is compared
// are these with each other.
#include "trace/node_storage.h"
#include "trace/trace_blocks.h"
#include "trace/traverse.h"
#include "trace/triangle_blocks_simd.h"

namespace bvhio {
namespace {

template <class Query, class Nodes, class Result>
void traceAll(const Nodes& nodes, const TriangleBlocks& blocks, std::span<const Ray> rays,
              std::span<Result> results) {
    NoMetrics metrics;
    for (size_t i = 0; i < rays.size(); ++i) {
        const PreparedRay ray(rays[i]);
        Query query(ray);
        if (!ray.missesByDefinition())
            HWY_NAMESPACE::traverse(nodes, HWY_NAMESPACE::BlockTriangles(blocks, ray), ray, query, metrics);
        results[i] = query.result();
    }
}

}  // namespace

template <>
void closestHitsInBlocks(const StoredNodes& stored, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits) {
    std::visit([&](const auto& nodes) { traceAll<ClosestHit>(nodes, blocks, rays, hits); }, stored);
}

template <>
void anyHitsInBlocks(const StoredNodes& stored, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded) {
    std::visit([&](const auto& nodes) { traceAll<AnyHit>(nodes, blocks, rays, occluded); }, stored);
}

}  // namespace bvhio
