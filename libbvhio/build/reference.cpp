#include "build/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/reference.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Makes the references of triangles [begin, end), with scaled boxes. Returns the bounds of the boxes.
Box makeSome(const Scene& scene, size_t begin, size_t end, float scale, Reference* references) {
    const TriangleBoxes boxes(scene, scale);
    BoxV all = BoxV::empty();
    for (size_t i = begin; i < end; ++i) {
        const BoxV box = boxes(scene.triangles[i]);
        all = unite(all, box);
        box.store(reinterpret_cast<float*>(references + i));
        references[i].primitive = uint32_t(i);
    }
    Box bounds;
    all.store(bounds.negatedMin);
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
    return boundsOfChunks(scene.triangles.size(), [&](size_t begin, size_t end) {
        return HWY_DYNAMIC_DISPATCH(makeSome)(scene, begin, end, scale, references);
    });
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

float areaScale(const Box& bounds) {
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::fabs(bounds.negatedMin[axis]), std::fabs(bounds.max[axis])});
    // Within 2^+-40, the area of a box times 2^31 primitives is far from overflow, and the area of a box
    // 2^-20 as large is far from underflow.
    if (!(largest > 0) || (largest <= 0x1p40f && largest >= 0x1p-40f)) return 1;
    return std::ldexp(1.0f, std::min(-std::ilogb(largest), 127));
}

bool makeReferences(const Scene& scene, Buffer<Reference>& references, Box& bounds, size_t room) {
    references = Buffer<Reference>(scene.triangles.size() + room);
    bounds = makeAll(scene, 1, references.data());
    const float scale = areaScale(bounds);
    if (scale == 1) return false;
    bounds = makeAll(scene, scale, references.data());
    return true;
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
