#include "trace/trace.h"

#include <mutex>

#include "core/parallel.h"
#include "trace/trace_blocks.h"
#include "trace/traverse.h"
#include "trace/traverse_two_level.h"

namespace bvhio {
namespace {

// Rays that one task traces: enough to make starting it cheap, few enough to share out.
constexpr size_t kRaysPerTask = 1024;

/// Traces one ray in the scene's own triangles.
template <class Query, class Form, class Metrics>
auto traceIndexed(const Form& form, const Scene& scene, const Ray& given, Metrics& metrics) {
    const PreparedRay ray(given);
    Query query(ray);
    if (!ray.missesByDefinition())
        HWY_NAMESPACE::traverse(form, HWY_NAMESPACE::IndexedTriangles{scene, form.primitives()}, ray, query,
                                metrics);
    return query.result();
}

template <class Query, class Result>
void traceAllIndexed(const Scene& scene, const EncodedBvh& bvh, std::span<const Ray> rays,
                     std::span<Result> results) {
    std::visit(
        [&](const auto& form) {
            NoMetrics metrics;
            for (size_t i = 0; i < rays.size(); ++i)
                results[i] = traceIndexed<Query>(form, scene, rays[i], metrics);
        },
        bvh);
}

bool isHit(const Hit& hit) {
    return !hit.isMiss();
}
bool isHit(bool occluded) {
    return occluded;
}

template <class Query, class Form>
TraceMeasurement measureForm(const Form& form, const Scene& scene, std::span<const Ray> rays,
                             std::span<RayCounts> perRay, std::span<FetchListener* const> listeners) {
    TraversalCounts sums;
    LocalityMetrics allLocality(form.nodeBytes());
    std::mutex mutex;
    // Large tasks: each has its own map of the blocks that were touched. Listeners hear one ray after the
    // other.
    const size_t raysPerTask = listeners.empty() ? 16 * kRaysPerTask : std::max(rays.size(), size_t(1));
    parallelChunks(rays.size(), raysPerTask, [&](size_t begin, size_t end) {
        CountMetrics counts;
        LocalityMetrics locality(form.nodeBytes());
        FetchMetrics fetches(listeners, scene, form.primitives());
        CombinedMetrics all(counts, locality, fetches);
        for (size_t i = begin; i < end; ++i) {
            fetches.beginRay(i);
            const bool hit = isHit(traceIndexed<Query>(form, scene, rays[i], all));
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

/// Tests the triangles of a range; true when the query is done.
template <class Query>
bool testEach(const Scene& scene, const PreparedRay& ray, PrimitiveRange range, Query& query) {
    for (uint32_t i = range.first; i < range.first + range.count; ++i) {
        Hit hit;
        hit.primitive = i;
        if (hitTriangle(ray, scene.triangle(i), query.tLimit(), hit) && query.offer(hit)) return true;
    }
    return false;
}

template <class Query>
auto bruteForce(const Scene& scene, const Ray& given) {
    const PreparedRay ray(given);
    Query query(ray);
    if (ray.missesByDefinition()) return query.result();
    if (!scene.isInstanced()) testEach(scene, ray, {0, uint32_t(scene.triangles.size())}, query);
    for (const InstanceEntry& instance : instanceEntries(scene)) {
        const RayInterval part = clipToBox(ray, instance.bounds, query.boxLimit());
        const PreparedRay local(objectRay(instance.toObject, ray));
        if (part.isEmpty() || local.missesByDefinition()) continue;
        InstanceQuery<Query> within(query, part.enter, instance.primitiveOffset);
        const SceneMesh& mesh = scene.meshes[instance.mesh];
        if (testEach(scene, local, {mesh.firstTriangle, mesh.triangleCount}, within)) break;
    }
    return query.result();
}

std::vector<PrimitiveRange> leavesOf(const EncodedBvh& encoded) {
    std::vector<PrimitiveRange> leaves;
    const auto addAmong = [&](std::span<const Node> nodes) {
        for (const Node& node : nodes)
            if (node.isLeaf()) leaves.push_back({node.first, node.primitiveCount});
    };
    if (isInstanced(encoded)) {
        const Forest meshes = std::get<TwoLevelForm>(encoded).decodeLevels().bottom;
        addAmong(meshes.roots);
        addAmong(meshes.nodes);
    } else {
        addAmong(decode(encoded).nodes);
    }
    return leaves;
}

/// Nodes in pairs are the aabb form's: nothing needs to be compiled for them apart.
template <class F>
const F& countedAs(const F& form) {
    return form;
}
const AabbForm& countedAs(const NodesInPairs& nodes) {
    return nodes;
}

}  // namespace

Tracer::Tracer(const Scene& scene, const EncodedBvh& bvh, TriangleSource source) : scene_(scene), bvh_(bvh) {
    if (source == TriangleSource::blocks) {
        const auto primitives =
            std::visit([](const auto& form) { return std::span<const uint32_t>(form.primitives()); }, bvh);
        blocks_.emplace(scene, primitives, leavesOf(bvh));
    }
}

Tracer::Tracer(const Scene& scene, const EncodedBvh& bvh, const NodeStorage& storage) : Tracer(scene, bvh) {
    const auto* form = std::get_if<AabbForm>(&bvh);
    if (form == nullptr)
        throw Error(ErrorKind::usage, "node storage '" + std::string(storage.name) +
                                          "' is for the aabb form, not " + std::string(formNameOf(bvh)) +
                                          ": convert it with bvh-compress --form aabb");
    stored_.emplace(storage.function(*form));
}

void Tracer::closestHits(std::span<const Ray> rays, std::span<Hit> hits) const {
    parallelChunks(rays.size(), kRaysPerTask, [&](size_t begin, size_t end) {
        const auto part = rays.subspan(begin, end - begin);
        const auto results = hits.subspan(begin, end - begin);
        if (stored_) return closestHitsInBlocks(*stored_, *blocks_, part, results);
        if (blocks_)
            return std::visit([&](const auto& form) { closestHitsInBlocks(form, *blocks_, part, results); },
                              bvh_);
        traceAllIndexed<ClosestHit>(scene_, bvh_, part, results);
    });
}

void Tracer::anyHits(std::span<const Ray> rays, std::span<uint8_t> occluded) const {
    parallelChunks(rays.size(), kRaysPerTask, [&](size_t begin, size_t end) {
        const auto part = rays.subspan(begin, end - begin);
        const auto results = occluded.subspan(begin, end - begin);
        if (stored_) return anyHitsInBlocks(*stored_, *blocks_, part, results);
        if (blocks_)
            return std::visit([&](const auto& form) { anyHitsInBlocks(form, *blocks_, part, results); },
                              bvh_);
        traceAllIndexed<AnyHit>(scene_, bvh_, part, results);
    });
}

TraceMeasurement Tracer::measure(std::span<const Ray> rays, Query query, std::span<RayCounts> perRay,
                                 std::span<FetchListener* const> listeners) const {
    const auto measure = [&](const auto& nodes) {
        const auto& form = countedAs(nodes);
        return query == Query::closest ? measureForm<ClosestHit>(form, scene_, rays, perRay, listeners)
                                       : measureForm<AnyHit>(form, scene_, rays, perRay, listeners);
    };
    return stored_ ? std::visit(measure, *stored_) : std::visit(measure, bvh_);
}

FetchedArraySizes Tracer::arraySizes() const {
    const auto sizes = [&](const auto& form) {
        return FetchedArraySizes{form.nodeBytes(), form.primitives().size() * sizeof(uint32_t),
                                 scene_.triangles.size() * sizeof(TriangleIndices),
                                 scene_.vertices.size() * sizeof(Vec3)};
    };
    return stored_ ? std::visit(sizes, *stored_) : std::visit(sizes, bvh_);
}

Hit bruteForceClosestHit(const Scene& scene, const Ray& ray) {
    return bruteForce<ClosestHit>(scene, ray);
}
bool bruteForceAnyHit(const Scene& scene, const Ray& ray) {
    return bruteForce<AnyHit>(scene, ray);
}

}  // namespace bvhio
