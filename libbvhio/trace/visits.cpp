#include "trace/visits.h"

#include <mutex>

#include "core/parallel.h"
#include "trace/step_aabb.h"
#include "trace/traverse.h"

namespace bvhio {
namespace {

// The rays of a task. Tasks are large, because each has its own counts.
constexpr size_t kRaysPerCount = 65536;

/// The metrics policy that counts fetches of each record.
struct VisitMetrics : NoMetrics {
    explicit VisitMetrics(size_t pairs) : counts(pairs, 0) {}
    std::vector<uint32_t> counts;

    void recordFetched(size_t offset, size_t) { ++counts[offset / (2 * sizeof(Node))]; }
};

template <class Query>
void visit(const AabbForm& form, const Scene& scene, std::span<const Ray> rays, VisitMetrics& metrics) {
    const HWY_NAMESPACE::Stepper<AabbForm> stepper(form);
    const HWY_NAMESPACE::IndexedTriangles triangles{scene, form.primitives()};
    for (const Ray& given : rays) {
        const PreparedRay ray(given);
        Query query(ray);
        if (!ray.missesByDefinition()) HWY_NAMESPACE::traverse(stepper, triangles, ray, query, metrics);
    }
}

}  // namespace

std::vector<uint32_t> countVisits(const Scene& scene, const Bvh& bvh, std::span<const Ray> rays,
                                  QueryKind query) {
    const AabbForm form(bvh);
    std::vector<uint32_t> sums(bvh.nodes.size() / 2, 0);
    std::mutex mutex;
    parallelChunks(rays.size(), kRaysPerCount, [&](size_t begin, size_t end) {
        VisitMetrics metrics(sums.size());
        const auto part = rays.subspan(begin, end - begin);
        if (query == QueryKind::closest)
            visit<ClosestHitQuery>(form, scene, part, metrics);
        else
            visit<AnyHitQuery>(form, scene, part, metrics);
        const std::lock_guard lock(mutex);
        for (size_t i = 0; i < sums.size(); ++i) sums[i] += metrics.counts[i];
    });
    return sums;
}

}  // namespace bvhio
