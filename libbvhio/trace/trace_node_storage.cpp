// Traces nodes that are stored in other ways. Compiled once, for every processor, since these are only
// compared with each other.
#include "trace/step_node_storage.h"
#include "trace/trace_form.h"
#include "trace/trace_indexed.h"
#include "trace/triangle_blocks_simd.h"

namespace bvhio {
namespace {

template <class Query, class Nodes, class Result>
void traceAll(const Nodes& nodes, const TriangleBlocks& blocks, std::span<const Ray> rays,
              std::span<Result> results) {
    NoMetrics metrics;
    const HWY_NAMESPACE::Stepper<Nodes> stepper(nodes);
    for (size_t i = 0; i < rays.size(); ++i) {
        const PreparedRay ray(rays[i]);
        Query query(ray);
        if (!ray.missesByDefinition())
            HWY_NAMESPACE::traverse(stepper, HWY_NAMESPACE::BlockTriangles(blocks, ray), ray, query, metrics);
        results[i] = query.result();
    }
}

}  // namespace

template <>
void closestHitsInBlocks(const StoredNodes& stored, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits) {
    std::visit([&](const auto& nodes) { traceAll<ClosestHitQuery>(nodes, blocks, rays, hits); }, stored);
}

template <>
void anyHitsInBlocks(const StoredNodes& stored, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded) {
    std::visit([&](const auto& nodes) { traceAll<AnyHitQuery>(nodes, blocks, rays, occluded); }, stored);
}

template <>
TraceMeasurement measureForm(const StoredNodes& stored, const Scene& scene, std::span<const Ray> rays,
                             QueryKind query, std::span<RayCounts> perRay,
                             std::span<FetchListener* const> listeners) {
    // Nodes in pairs are the aabb form's, for which this is compiled already.
    if (const auto* pairs = std::get_if<NodesInPairs>(&stored))
        return measureForm<AabbForm>(*pairs, scene, rays, query, perRay, listeners);
    return std::visit(
        [&](const auto& nodes) -> TraceMeasurement {
            if constexpr (std::is_same_v<std::decay_t<decltype(nodes)>, NodesInPairs>)
                return {};
            else
                return query == QueryKind::closest
                           ? HWY_NAMESPACE::measureAll<ClosestHitQuery>(nodes, scene, rays, perRay, listeners)
                           : HWY_NAMESPACE::measureAll<AnyHitQuery>(nodes, scene, rays, perRay, listeners);
        },
        stored);
}

}  // namespace bvhio
