// Bins along the three axes, their contents, and the best plane between them. Included once for each SIMD
// target.
#if defined(BVHIO_BUILD_BINS_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_BUILD_BINS_SIMD_H
#undef BVHIO_BUILD_BINS_SIMD_H
#else
#define BVHIO_BUILD_BINS_SIMD_H
#endif

#include <hwy/highway.h>

#include <cstring>

#include "build/binned.h"
#include "build/boxes_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

constexpr uint32_t kTwoSets = 512;  // from this many references on, two sets of bins are faster

/// Maps doubled centroids to bins: bin = round((centroid - origin) * scale - 0.5), by the same operations
/// everywhere. Adding 2^23 - 0.5 leaves the bin in the low bits of the float.
struct Grid {
    alignas(16) float origin[4];
    alignas(16) float scale[4];
    uint32_t bins;  // per axis
    static constexpr float kRound = 8388607.5f, kZero = 8388608.0f;

    /// Divides `span` times `factor`, which contains all doubled centroids. If it is flat on an axis, all are
    /// in bin 0.
    Grid(const Box& span, float factor, uint32_t binCount) : bins(binCount) {
        for (int axis = 0; axis < 4; ++axis) {
            const float extent = axis < 3 ? span.extent(axis) * factor : 0;
            origin[axis] = axis < 3 ? 0 - span.negatedMin[axis] * factor : 0;
            // Slightly less than all bins, so that rounding cannot reach the bin after the last.
            scale[axis] = extent > 0x1p-100f ? float(binCount) * 0.9999f / extent : 0;
        }
    }
};

/// The contents of each bin, axis by axis: the union of the boxes, in Box's order, and their number.
struct Bins {
    alignas(64) float boxes[3 * kMaxBins][8];
    uint32_t counts[3 * kMaxBins];
    uint32_t perAxis;

    void clear(uint32_t bins) {
        perAxis = bins;
        for (uint32_t i = 0; i < 3 * bins; ++i) BoxV::empty().store(boxes[i]);
        std::memset(counts, 0, 3 * bins * sizeof counts[0]);
    }
    void merge(const Bins& other) {
        for (uint32_t i = 0; i < 3 * perAxis; ++i) {
            unite(BoxV::load(boxes[i]), BoxV::load(other.boxes[i])).store(boxes[i]);
            counts[i] += other.counts[i];
        }
    }
};

/// References whose bin on `axis` is at most `lastLeft` go left.
struct Split {
    float cost = kInfinity;
    int axis = -1;
    uint32_t lastLeft = 0;
};

HWY_INLINE const float* floats(const Reference* reference) {
    return reinterpret_cast<const float*>(reference);
}

/// Adds references to bins. Neighbours in a mesh share bins, and each addition to a bin waits for the one
/// before. So odd references may go to a second set of bins.
void fillBins(const Reference* references, uint32_t count, const Grid& grid, Bins& even, Bins& odd) {
    const Four d;
    const FourU du;
    const FourV three = firstThree();
    const FourV origin = hn::Load(d, grid.origin), scale = hn::Load(d, grid.scale);
    const FourV round = hn::Set(d, Grid::kRound), zero = hn::Set(d, Grid::kZero);
    const auto add = [&](const Reference* reference, Bins& bins) HWY_ATTR {
        const BoxV box = BoxV::load(floats(reference));
        const FourV centroid = hn::Sub(hn::And(box.high(), three), hn::And(box.low(), three));
        const FourV bin = hn::Max(hn::Add(hn::Mul(hn::Sub(centroid, origin), scale), round), zero);
        alignas(16) uint32_t lanes[4];
        hn::Store(hn::BitCast(du, bin), du, lanes);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const uint32_t at = axis * grid.bins + (lanes[axis] & 0xFF);
            unite(BoxV::load(bins.boxes[at]), box).store(bins.boxes[at]);
            ++bins.counts[at];
        }
    };
    uint32_t i = 0;
    for (; i + 1 < count; i += 2) {
        add(references + i, even);
        add(references + i + 1, odd);
    }
    if (i < count) add(references + i, even);
}

void fillBins(const Reference* references, uint32_t count, const Grid& grid, Bins& bins) {
    bins.clear(grid.bins);
    if (count < kTwoSets) return fillBins(references, count, grid, bins, bins);
    Bins odd;
    odd.clear(grid.bins);
    fillBins(references, count, grid, bins, odd);
    bins.merge(odd);
}

/// Returns the half areas of four boxes, lane by lane, from their extents. An empty box has an infinite area.
HWY_INLINE FourV halfAreas(const float (*extents)[4]) {
    const Four d;
    FourV x, y, z, unused;
    hn::LoadInterleaved4(d, extents[0], x, y, z, unused);
    return hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
}

/// Returns the plane of least SAH cost over all axes; of equals, the first. Its axis is < 0 if all references
/// are in one bin of each axis.
Split bestSplit(const Bins& bins, uint32_t count) {
    const Four d;
    alignas(16) float lefts[kMaxBins + 3][4],
        rights[kMaxBins + 3][4];  // extents of both sides of the plane after bin i
    alignas(16) float leftCounts[kMaxBins + 3];
    const uint32_t planes = bins.perAxis - 1;
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        const float(*boxes)[8] = bins.boxes + axis * bins.perAxis;
        const uint32_t* counts = bins.counts + axis * bins.perAxis;
        BoxV left = BoxV::empty(), right = BoxV::empty();
        uint32_t leftCount = 0;
        for (uint32_t i = 0; i < planes; ++i) {
            left = unite(left, BoxV::load(boxes[i]));
            right = unite(right, BoxV::load(boxes[planes - i]));
            hn::Store(hn::Add(left.low(), left.high()), d, lefts[i]);
            hn::Store(hn::Add(right.low(), right.high()), d, rights[planes - 1 - i]);
            leftCount += counts[i];
            leftCounts[i] = float(leftCount);
        }
        for (uint32_t i = planes; i % 4 != 0; ++i) {  // fill the last group with planes that are never better
            hn::Store(hn::Set(d, kInfinity), d, lefts[i]);
            hn::Store(hn::Set(d, kInfinity), d, rights[i]);
            leftCounts[i] = 0;
        }
        // The cost of an empty side is infinity times zero: not a number, and so never less than another
        // cost.
        FourV bestCosts = hn::Set(d, kInfinity), bestPlanes = hn::Zero(d), plane = hn::Iota(d, 0);
        for (uint32_t i = 0; i < planes; i += 4) {
            const FourV leftCounts4 = hn::Load(d, leftCounts + i);
            const FourV costs =
                hn::Add(hn::Mul(halfAreas(lefts + i), leftCounts4),
                        hn::Mul(halfAreas(rights + i), hn::Sub(hn::Set(d, float(count)), leftCounts4)));
            const auto better = hn::Lt(costs, bestCosts);
            bestCosts = hn::IfThenElse(better, costs, bestCosts);
            bestPlanes = hn::IfThenElse(better, plane, bestPlanes);
            plane = hn::Add(plane, hn::Set(d, 4));
        }
        alignas(16) float laneCosts[4], lanePlanes[4];
        hn::Store(bestCosts, d, laneCosts);
        hn::Store(bestPlanes, d, lanePlanes);
        Split ofAxis;
        for (int lane = 0; lane < 4; ++lane) {
            const auto lanePlane = uint32_t(lanePlanes[lane]);
            if (laneCosts[lane] < ofAxis.cost ||
                (laneCosts[lane] == ofAxis.cost && lanePlane < ofAxis.lastLeft))
                ofAxis = {laneCosts[lane], axis, lanePlane};
        }
        if (ofAxis.cost < best.cost) best = ofAxis;
    }
    return best;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#endif
