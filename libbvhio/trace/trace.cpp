#include "trace/trace.h"

#include "core/parallel.h"
#include "trace/queries.h"

namespace bvhio {
namespace {

// The rays of one task: enough that starting it costs little, and few enough to share the work.
constexpr size_t kRaysPerTask = 1024;

/// Tests the triangles of a range. Returns whether the query is done.
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
        std::visit([&](const auto& form) { closestHitsIndexed(form, scene_, part, results); }, bvh_);
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
        std::visit([&](const auto& form) { anyHitsIndexed(form, scene_, part, results); }, bvh_);
    });
}

TraceMeasurement Tracer::measure(std::span<const Ray> rays, QueryKind query, std::span<RayCounts> perRay,
                                 std::span<FetchListener* const> listeners) const {
    if (stored_) return measureForm(*stored_, scene_, rays, query, perRay, listeners);
    return std::visit(
        [&](const auto& form) { return measureForm(form, scene_, rays, query, perRay, listeners); }, bvh_);
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
    return bruteForce<ClosestHitQuery>(scene, ray);
}
bool bruteForceAnyHit(const Scene& scene, const Ray& ray) {
    return bruteForce<AnyHitQuery>(scene, ray);
}

}  // namespace bvhio
