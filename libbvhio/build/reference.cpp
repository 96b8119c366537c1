#include "build/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/reference.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourV = hn::Vec<Four>;

/// A vertex, the next one's x in the fourth lane; the array's last vertex has no next.
HWY_INLINE FourV load(const Vec3* vertices, uint32_t last, uint32_t index) {
    const Four d;
    if (HWY_LIKELY(index != last)) return hn::LoadU(d, &vertices[index].x);
    alignas(16) const float lanes[4] = {vertices[index].x, vertices[index].y, vertices[index].z, 0};
    return hn::Load(d, lanes);
}

/// References of triangles [begin, end), their boxes scaled; returns the boxes' bounds.
Box makeSome(const Scene& scene, size_t begin, size_t end, float scale, Reference* references) {
    const Four d;
    const hn::RebindToUnsigned<Four> du;
    const Vec3* vertices = scene.vertices.data();
    const auto lastVertex = uint32_t(scene.vertices.size() - 1);
    const FourV factor = hn::Set(d, scale);
    alignas(16) static constexpr uint32_t kThree[4] = {~0u, ~0u, ~0u, 0};
    const FourV three = hn::BitCast(d, hn::Load(du, kThree));
    FourV lows = hn::Set(d, -std::numeric_limits<float>::infinity()), highs = lows;
    for (size_t i = begin; i < end; ++i) {
        const TriangleIndices& t = scene.triangles[i];
        const FourV v0 = load(vertices, lastVertex, t.v0), v1 = load(vertices, lastVertex, t.v1),
                    v2 = load(vertices, lastVertex, t.v2);
        // 0 - min, not -min: a -0 would make unions depend on their order.
        const FourV low = hn::And(hn::Sub(hn::Zero(d), hn::Mul(hn::Min(hn::Min(v0, v1), v2), factor)), three);
        const FourV high = hn::And(hn::Mul(hn::Max(hn::Max(v0, v1), v2), factor), three);
        lows = hn::Max(lows, low);
        highs = hn::Max(highs, high);
        auto* lanes = reinterpret_cast<float*>(references + i);
        hn::Store(low, d, lanes);
        hn::Store(high, d, lanes + 4);
        references[i].primitive = uint32_t(i);
    }
    Box bounds;
    hn::Store(lows, d, bounds.negatedMin);
    hn::Store(highs, d, bounds.max);
    return bounds;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(makeSome);

Box makeAll(const Scene& scene, float scale, Reference* references) {
    constexpr size_t kGrain = 1 << 13;
    const size_t count = scene.triangles.size();
    std::vector<Box> chunks((count + kGrain - 1) / kGrain);
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        chunks[begin / kGrain] = HWY_DYNAMIC_DISPATCH(makeSome)(scene, begin, end, scale, references);
    });
    Box bounds = Box::empty();
    for (const Box& chunk : chunks) bounds.extend(chunk);
    return bounds;
}

}  // namespace

Box centroidBounds(const Reference* references, size_t count) {
    Box bounds = Box::empty();
    for (size_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const float centroid = references[i].centroid(axis);
            bounds.negatedMin[axis] = std::max(bounds.negatedMin[axis], 0 - centroid);
            bounds.max[axis] = std::max(bounds.max[axis], centroid);
        }
    return bounds;
}

bool makeReferences(const Scene& scene, Buffer<Reference>& references, Box& bounds) {
    references = Buffer<Reference>(scene.triangles.size());
    bounds = makeAll(scene, 1, references.data());
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::fabs(bounds.negatedMin[axis]), std::fabs(bounds.max[axis])});
    // Within 2^+-40 the area of a box, times 2^31 primitives, stays far from overflow, and so does that of a
    // box 2^-20 as large from underflow.
    const bool rescaled = largest > 0 && (largest > 0x1p40f || largest < 0x1p-40f);
    if (rescaled)
        bounds = makeAll(scene, std::ldexp(1.0f, std::min(-std::ilogb(largest), 127)), references.data());
    return rescaled;
}

SharedArray<Node> refitted(const Scene& scene, const Bvh& bvh) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    for (size_t i = nodes.size(); i-- > 0;) {
        if (i == 1) continue;  // the unused slot
        Node& node = nodes[i];
        node.bounds = Aabb::empty();
        if (node.isLeaf()) {
            for (uint32_t k = node.first; k < node.first + node.primitiveCount; ++k)
                node.bounds.extend(bvhio::bounds(scene.triangle(bvh.primitives[k])));
        } else {
            node.bounds = unite(nodes[node.left()].bounds, nodes[node.right()].bounds);
        }
    }
    return nodes;
}

}  // namespace bvhio
#endif
