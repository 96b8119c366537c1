// Finds the best split of a range's references by binned centroids, and moves the references. Included once
// for each SIMD target.
#if defined(BVHIO_BUILD_OBJECT_SPLIT_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_BUILD_OBJECT_SPLIT_SIMD_H
#undef BVHIO_BUILD_OBJECT_SPLIT_SIMD_H
#else
#define BVHIO_BUILD_OBJECT_SPLIT_SIMD_H
#endif

#include <algorithm>
#include <vector>

#include "build/bins_simd.h"
#include "build/top_down.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

constexpr uint32_t kGrain = 1 << 13;  // references that a task bins or moves at a time

/// Returns the default number of bins: many for many references, whose split affects a large subtree, and few
/// for few references.
uint32_t defaultBins(uint32_t count) {
    return count >= 1u << 16 ? 64 : count >= 32 ? 16 : 8;
}

/// A plane between bins of centroids.
struct ObjectSplit {
    Grid grid;
    Split plane;
    std::vector<uint32_t> leftsBefore;  // references that go left before each chunk, if found in chunks

    ObjectSplit() : grid(Box::empty(), 0, 0) {}
};

/// Copies references to the side where they belong, in order.
void partition(const Reference* references, uint32_t count, const Grid& grid, const Split& split,
               Reference* left, Reference* right) {
    const int axis = split.axis;
    const float origin = grid.origin[axis], scale = grid.scale[axis],
                limit = Grid::kZero + float(split.lastLeft);
    for (uint32_t i = 0; i < count; ++i) {
        const Reference& reference = references[i];
        const bool isRight = (reference.centroid(axis) - origin) * scale + Grid::kRound > limit;
        // Without a branch, which the processor could not predict.
        Reference* const to = isRight ? right : left;
        BoxV::load(floats(&reference)).store(reinterpret_cast<float*>(to));
        right += isRight;
        left += !isRight;
    }
}

/// Sets the bounds and counts of both sides, from the bins.
void describeSides(const Bins& bins, const Split& split, Range& left, Range& right) {
    const float(*boxes)[8] = bins.boxes + split.axis * bins.perAxis;
    const uint32_t* counts = bins.counts + split.axis * bins.perAxis;
    const auto describe = [&](uint32_t begin, uint32_t end, Range& side) HWY_ATTR {
        BoxV bounds = BoxV::empty();
        side.count = 0;
        for (uint32_t i = begin; i < end; ++i) {
            bounds = unite(bounds, BoxV::load(boxes[i]));
            side.count += counts[i];
        }
        bounds.store(side.bounds.negatedMin);
    };
    describe(0, split.lastLeft + 1, left);
    describe(split.lastLeft + 1, bins.perAxis, right);
}

/// Finds the best plane between the bins of `best.grid`. Returns false if all references are in one bin of
/// each axis.
bool findOverGrid(const Reference* references, uint32_t count, bool parallel, ObjectSplit& best, Range& left,
                  Range& right) {
    Bins bins;
    if (!parallel) {
        fillBins(references, count, best.grid, bins);
        best.plane = bestSplit(bins, count);
        if (best.plane.axis < 0) return false;
        describeSides(bins, best.plane, left, right);
        return true;
    }
    Buffer<Bins> chunks((count + kGrain - 1) / kGrain);
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        fillBins(references + begin, uint32_t(end - begin), best.grid, chunks[begin / kGrain]);
    });
    bins.clear(best.grid.bins);
    for (size_t i = 0; i < chunks.size(); ++i) bins.merge(chunks[i]);
    best.plane = bestSplit(bins, count);
    if (best.plane.axis < 0) return false;
    describeSides(bins, best.plane, left, right);

    // Count the references that go left before each chunk, from the chunks' bins.
    best.leftsBefore.resize(chunks.size());
    uint32_t lefts = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
        best.leftsBefore[i] = lefts;
        const uint32_t* counts = chunks[i].counts + best.plane.axis * best.grid.bins;
        for (uint32_t bin = 0; bin <= best.plane.lastLeft; ++bin) lefts += counts[bin];
    }
    return true;
}

/// Finds the split of least SAH cost among the planes between `bins` bins per axis (0 = by the number of
/// references), and the bounds and counts of its sides. Returns false if there is no split, because the range
/// has no area or all centroids coincide.
bool findObjectSplit(const ReferenceArrays& references, const Range& range, uint32_t bins, bool parallel,
                     ObjectSplit& best, Range& left, Range& right) {
    // The SAH cannot compare planes if boxes have no area (all on a line or a point).
    if (!(range.bounds.halfArea() > std::numeric_limits<float>::min())) return false;
    if (bins == 0) bins = defaultBins(range.count);
    best.grid = Grid(range.bounds, 2, bins);
    if (findOverGrid(references.at(range), range.count, parallel, best, left, right)) return true;
    best.grid = Grid(centroidBounds(references.at(range), range.count), 1, bins);
    return findOverGrid(references.at(range), range.count, parallel, best, left, right);
}

/// Moves a range's references to the opposite array.
void moveReferences(const ReferenceArrays& references, const Range& range, const ObjectSplit& split,
                    uint32_t rightCount, bool parallel) {
    const Reference* source = references.at(range);
    Reference* const left = references.left(range);
    Reference* const right = references.right(range, rightCount);
    if (!parallel) return partition(source, range.count, split.grid, split.plane, left, right);
    parallelChunks(range.count, kGrain, [&](size_t begin, size_t end) {
        const uint32_t before = split.leftsBefore[begin / kGrain];
        partition(source + begin, uint32_t(end - begin), split.grid, split.plane, left + before,
                  right + (begin - before));
    });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#endif
