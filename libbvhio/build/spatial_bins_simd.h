// Bins of space (slabs) along the three axes. References are cut where they cross from one slab to the next,
// and the best plane between slabs is a candidate for a spatial split. Included once for each SIMD target.
#if defined(BVHIO_BUILD_SPATIAL_BINS_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_BUILD_SPATIAL_BINS_SIMD_H
#undef BVHIO_BUILD_SPATIAL_BINS_SIMD_H
#else
#define BVHIO_BUILD_SPATIAL_BINS_SIMD_H
#endif

#include <algorithm>
#include <utility>

#include "build/bins_simd.h"
#include "scene/scene.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

constexpr uint32_t kMaxSlabs = 64;

/// Equal slabs along each axis of a box, and the planes between them.
struct Slabs {
    alignas(16) float origin[4], scale[4], step[4];
    uint32_t count;  // per axis

    Slabs(const Box& span, uint32_t slabs) : count(slabs) {
        for (int axis = 0; axis < 4; ++axis) {
            const float extent = axis < 3 ? span.extent(axis) : 0;
            const bool wide = extent > 0x1p-100f;
            origin[axis] = axis < 3 ? 0 - span.negatedMin[axis] : 0;
            scale[axis] = wide ? float(slabs) / extent : 0;
            step[axis] = wide ? extent / float(slabs) : 0;
        }
    }
    /// Returns the plane between slabs i - 1 and i.
    HWY_INLINE float plane(int axis, uint32_t i) const { return origin[axis] + float(i) * step[axis]; }
};

/// The slabs in which a reference starts and ends, axis by axis. A reference that only touches the plane to
/// the next slab does not enter that slab.
struct SlabRange {
    alignas(16) int32_t first[4], last[4];
};

HWY_INLINE SlabRange slabsOf(const Reference& reference, const Slabs& slabs) {
    const Four d;
    const hn::FixedTag<int32_t, 4> di;
    const FourV three = firstThree();
    const float* lanes = floats(&reference);
    const FourV low = hn::And(hn::Load(d, lanes), three), high = hn::And(hn::Load(d, lanes + 4), three);
    const FourV origin = hn::Load(d, slabs.origin), scale = hn::Load(d, slabs.scale);
    const FourV from = hn::Mul(hn::Sub(hn::Sub(hn::Zero(d), low), origin), scale);
    const FourV to = hn::Mul(hn::Sub(high, origin), scale);
    const auto most = hn::Set(di, int32_t(slabs.count) - 1), zero = hn::Zero(di);
    const auto first = hn::Max(hn::Min(hn::ConvertTo(di, from), most), zero);
    const auto floor = hn::ConvertTo(di, to);
    // The mask of lanes where `to` is on a plane is -1 as an integer.
    const auto onPlane = hn::VecFromMask(di, hn::RebindMask(di, hn::Eq(hn::ConvertTo(d, floor), to)));
    const auto last = hn::Max(hn::Min(hn::Add(floor, onPlane), most), first);
    SlabRange range;
    hn::Store(first, di, range.first);
    hn::Store(last, di, range.last);
    return range;
}

/// The contents of each slab, axis by axis: the union of the boxes of parts, and the numbers of references
/// that start and end there.
struct SpatialBins {
    alignas(64) float boxes[3 * kMaxSlabs][8];
    uint32_t starts[3 * kMaxSlabs], ends[3 * kMaxSlabs];
    uint32_t perAxis;

    void clear(uint32_t slabs) {
        perAxis = slabs;
        for (uint32_t i = 0; i < 3 * slabs; ++i) BoxV::empty().store(boxes[i]);
        std::memset(starts, 0, 3 * slabs * sizeof starts[0]);
        std::memset(ends, 0, 3 * slabs * sizeof ends[0]);
    }
    void merge(const SpatialBins& other) {
        for (uint32_t i = 0; i < 3 * perAxis; ++i) {
            unite(BoxV::load(boxes[i]), BoxV::load(other.boxes[i])).store(boxes[i]);
            starts[i] += other.starts[i];
            ends[i] += other.ends[i];
        }
    }
};

/// A triangle, prepared for cuts along any axis.
struct Corners {
    alignas(32) float at[3][8];        // the corners as boxes
    alignas(32) float edges[3][8];     // from corner i to corner i + 1
    alignas(16) float inverses[3][4];  // 1 / the edge's extent on each axis; 0 if the extent is 0
    uint8_t orders[3];                 // by axis: bit i is set if corner i + 1 < corner i

    HWY_INLINE Corners(const Scene& scene, uint32_t triangle) {
        const Four d;
        const TriangleIndices& t = scene.triangles[triangle];
        const uint32_t indices[3] = {t.v0, t.v1, t.v2};
        const auto last = uint32_t(scene.vertices.size() - 1);
        FourV corners[3];
        for (int i = 0; i < 3; ++i) {
            corners[i] = loadVertex(scene.vertices.data(), last, indices[i]);
            hn::Store(hn::Neg(corners[i]), d, at[i]);
            hn::Store(corners[i], d, at[i] + 4);
        }
        uint32_t bits[3];
        for (int i = 0; i < 3; ++i) {
            const FourV edge = hn::Sub(corners[i < 2 ? i + 1 : 0], corners[i]);
            hn::Store(hn::Neg(edge), d, edges[i]);
            hn::Store(edge, d, edges[i] + 4);
            const auto none = hn::Eq(edge, hn::Zero(d));
            const FourV one = hn::Set(d, 1);
            hn::Store(hn::IfThenZeroElse(none, hn::Div(one, hn::IfThenElse(none, one, edge))), d,
                      inverses[i]);
            uint8_t mask[8];
            hn::StoreMaskBits(d, hn::Lt(edge, hn::Zero(d)), mask);
            bits[i] = mask[0];
        }
        for (int axis = 0; axis < 3; ++axis)
            orders[axis] =
                uint8_t((bits[0] >> axis & 1) | (bits[1] >> axis & 1) << 1 | (bits[2] >> axis & 1) << 2);
    }
};

/// By Corners::orders: the lowest, middle and highest corner, then the edges that join the lowest to the
/// highest, the lowest to the middle and the middle to the highest. The three edges cannot all fall, or all
/// rise.
constexpr uint8_t kOrders[8][6] = {
    {0, 1, 2, 2, 0, 1},  // no edge falls: the corners are equal
    {1, 2, 0, 0, 1, 2},  // 1 < 0, 1 <= 2, 2 <= 0
    {2, 0, 1, 1, 2, 0},  // 0 <= 1, 2 < 1, 2 <= 0
    {2, 1, 0, 2, 1, 0},  // 2 < 1 < 0
    {0, 1, 2, 2, 0, 1},  // 0 <= 1 <= 2
    {1, 0, 2, 1, 0, 2},  // 1 < 0 < 2
    {0, 2, 1, 0, 2, 1},  // 0 < 2 < 1
    {0, 1, 2, 2, 0, 1},
};

/// Adds to each of the slabs `first` to `last` of an axis the box of the reference's part there: the part of
/// the triangle between the slab's planes and inside the reference's box. The boxes only guide the choice of
/// a plane, and are not conservative.
HWY_INLINE void addParts(const Corners& corners, const Reference& reference, int axis, uint32_t first,
                         uint32_t last, const Slabs& slabs, float (*boxes)[8]) {
    const uint8_t* order = kOrders[corners.orders[axis]];
    const float *lowCorner = corners.at[order[0]], *middleCorner = corners.at[order[1]],
                *highCorner = corners.at[order[2]];
    const float a = lowCorner[4 + axis], b = middleCorner[4 + axis], c = highCorner[4 + axis];
    const BoxV low = BoxV::load(lowCorner), middle = BoxV::load(middleCorner), high = BoxV::load(highCorner);
    // The change along each edge for a step of 1 on the axis.
    const auto slope = [&](uint8_t edge) HWY_ATTR {
        return BoxV::load(corners.edges[edge]) * corners.inverses[edge][axis];
    };
    const BoxV lowToHigh = slope(order[3]), lowToMiddle = slope(order[4]), middleToHigh = slope(order[5]);
    // The segments in which the triangle crosses planes below and above its middle corner.
    const auto cutBelow = [&](float plane) HWY_ATTR {
        return unite(low + lowToHigh * (plane - a), low + lowToMiddle * (plane - a));
    };
    const auto cutAbove = [&](float plane) HWY_ATTR {
        return unite(low + lowToHigh * (plane - a), middle + middleToHigh * (plane - b));
    };
    const BoxV own = BoxV::load(floats(&reference));
    const auto add = [&](uint32_t slab, BoxV part) HWY_ATTR {
        unite(BoxV::load(boxes[slab]), intersect(part, own)).store(boxes[slab]);
    };

    const float start = 0 - reference.negatedMin[axis], end = reference.max[axis];
    BoxV from = a >= start ? low : b > start ? cutBelow(start) : cutAbove(start);
    uint32_t slab = first;
    for (; slab < last; ++slab) {
        const float plane = slabs.plane(axis, slab + 1);
        if (!(plane < b)) break;
        const BoxV to = cutBelow(plane);
        add(slab, unite(from, to));
        from = to;
    }
    if (b >= start && b <= end) from = unite(from, middle);
    for (; slab < last; ++slab) {
        const BoxV to = cutAbove(slabs.plane(axis, slab + 1));
        add(slab, unite(from, to));
        from = to;
    }
    add(last, unite(from, c <= end ? high : b > end ? cutBelow(end) : cutAbove(end)));
}

/// Adds the boxes of references, or of their parts, to the slabs that they are in, and counts their starts
/// and ends.
void fillSlabs(const Scene& scene, const Reference* references, uint32_t count, const Slabs& slabs,
               SpatialBins& bins) {
    for (uint32_t i = 0; i < count; ++i) {
        const Reference& reference = references[i];
        const SlabRange range = slabsOf(reference, slabs);
        const BoxV box = BoxV::load(floats(&reference));
        uint32_t crossed = 0;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const uint32_t first = axis * slabs.count + uint32_t(range.first[axis]),
                           last = axis * slabs.count + uint32_t(range.last[axis]);
            ++bins.starts[first];
            ++bins.ends[last];
            if (first != last)
                crossed |= 1u << axis;
            else
                unite(BoxV::load(bins.boxes[first]), box).store(bins.boxes[first]);
        }
        if (crossed == 0) continue;
        const Corners corners(scene, reference.primitive);
        for (int axis = 0; axis < 3; ++axis)
            if (crossed >> axis & 1)
                addParts(corners, reference, axis, uint32_t(range.first[axis]), uint32_t(range.last[axis]),
                         slabs, bins.boxes + uint32_t(axis) * slabs.count);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#endif
