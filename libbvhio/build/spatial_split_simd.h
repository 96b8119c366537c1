// Finds the best spatial split of a range's references. Included once for each SIMD target.
#if defined(BVHIO_BUILD_SPATIAL_SPLIT_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_BUILD_SPATIAL_SPLIT_SIMD_H
#undef BVHIO_BUILD_SPATIAL_SPLIT_SIMD_H
#else
#define BVHIO_BUILD_SPATIAL_SPLIT_SIMD_H
#endif

#include <vector>

#include "build/spatial_bins_simd.h"
#include "core/parallel.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// References that end in slabs up to `lastLeft` go left. Those that start in later slabs go right. The
/// others are cut.
struct SpatialPlane {
    float cost = kInfinity;
    int axis = -1;
    uint32_t lastLeft = 0;
    uint32_t leftCount = 0, rightCount = 0;
};

/// A plane between slabs. For each chunk of `grain` references, the chunks before it have `leftBefore` whole
/// references on the left and `crossingBefore` cut ones.
struct SpatialSplit {
    struct Chunk {
        uint32_t leftBefore = 0, crossingBefore = 0;
    };
    Slabs slabs;
    uint32_t grain;
    SpatialPlane plane;
    std::vector<Chunk> chunks;

    SpatialSplit(const Box& span, uint32_t slabCount, uint32_t chunkGrain)
        : slabs(span, slabCount), grain(chunkGrain) {}
};

enum class Side { left, right, both };

HWY_INLINE Side sideOf(const Reference& reference, const SpatialSplit& split) {
    const SlabRange range = slabsOf(reference, split.slabs);
    const int axis = split.plane.axis;
    return uint32_t(range.last[axis]) <= split.plane.lastLeft   ? Side::left
           : uint32_t(range.first[axis]) > split.plane.lastLeft ? Side::right
                                                                : Side::both;
}

/// Returns whether a plane gives each side at least one reference and fewer than all, and both together fit.
HWY_INLINE bool mayCut(uint32_t leftCount, uint32_t rightCount, uint32_t count, uint32_t capacity) {
    return leftCount > 0 && rightCount > 0 && leftCount < count && rightCount < count &&
           leftCount + rightCount <= capacity;
}

HWY_INLINE float halfArea(BoxV bounds) {
    Box box;
    bounds.store(box.negatedMin);
    return box.halfArea();
}

/// Returns the plane of least SAH cost among those that may cut; of equals, the first.
SpatialPlane bestSpatialPlane(const SpatialBins& bins, uint32_t count, uint32_t capacity) {
    SpatialPlane best;
    float rightAreas[kMaxSlabs];
    for (int axis = 0; axis < 3; ++axis) {
        const uint32_t first = uint32_t(axis) * bins.perAxis;
        BoxV right = BoxV::empty();
        for (uint32_t i = bins.perAxis - 1; i > 0; --i) {
            right = unite(right, BoxV::load(bins.boxes[first + i]));
            rightAreas[i - 1] = halfArea(right);
        }
        BoxV left = BoxV::empty();
        uint32_t started = 0, ended = 0;
        for (uint32_t i = 0; i + 1 < bins.perAxis; ++i) {
            left = unite(left, BoxV::load(bins.boxes[first + i]));
            started += bins.starts[first + i];
            ended += bins.ends[first + i];
            if (!mayCut(started, count - ended, count, capacity)) continue;
            const float cost = halfArea(left) * float(started) + rightAreas[i] * float(count - ended);
            if (cost < best.cost) best = {cost, axis, i, started, count - ended};
        }
    }
    return best;
}

/// Finds the best plane between the split's slabs that turns `count` references into at most `capacity`.
/// Returns false if there is no such plane.
bool findSpatialSplit(const Scene& scene, const Reference* references, uint32_t count, uint32_t capacity,
                      SpatialSplit& split) {
    // Fill the slabs, chunk by chunk.
    const size_t chunkCount = (count + split.grain - 1) / split.grain;
    SpatialBins all;
    Buffer<SpatialBins> chunks(chunkCount > 1 ? chunkCount : 0);
    const auto binsOf = [&](size_t chunk) -> SpatialBins& { return chunkCount > 1 ? chunks[chunk] : all; };
    parallelChunks(count, split.grain, [&](size_t begin, size_t end) {
        SpatialBins& bins = binsOf(begin / split.grain);
        bins.clear(split.slabs.count);
        fillSlabs(scene, references + begin, uint32_t(end - begin), split.slabs, bins);
    });
    if (chunkCount > 1) {
        all.clear(split.slabs.count);
        for (size_t i = 0; i < chunkCount; ++i) all.merge(chunks[i]);
    }
    split.plane = bestSpatialPlane(all, count, capacity);
    if (split.plane.axis < 0) return false;

    // Count the references on the left and the cut ones before each chunk.
    split.chunks.resize(chunkCount);
    SpatialSplit::Chunk before;
    for (size_t i = 0; i < chunkCount; ++i) {
        split.chunks[i] = before;
        const uint32_t first = uint32_t(split.plane.axis) * split.slabs.count;
        for (uint32_t slab = first; slab <= first + split.plane.lastLeft; ++slab) {
            before.leftBefore += binsOf(i).ends[slab];
            before.crossingBefore += binsOf(i).starts[slab] - binsOf(i).ends[slab];
        }
    }
    return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#endif
