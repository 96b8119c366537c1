// Binned SAH (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"): centroids fall
// into equal bins along each axis, and the best plane between bins, by the SAH, splits the node. Departures:
// the bins span the node's box rather than its centroids' box, which spares a pass and, at 16 bins, costs up
// to about 1% of quality; they span the centroids' when all centroids share a bin. Every axis is binned in
// one pass, and the widest nodes by all threads in chunks; partitions keep order, so that the result does not
// depend on the chunks; ranges of a few primitives are solved exactly (small_tree); leaves are decided
// bottom-up (top_down).

#include "build/binned.h"

#include <algorithm>
#include <string>

#include "build/top_down.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/binned.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/bins_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

constexpr uint32_t kGrain = 1 << 13;  // references that a task bins or moves at a time

/// Bins by default: many where a node is wide and its choice weighs on all below, few where references are.
uint32_t defaultBins(uint32_t count) {
    return count >= 1u << 16 ? 64 : count >= 32 ? 16 : 8;
}

/// Copies references to the side where they belong, in order.
void partition(const Reference* references, uint32_t count, const Grid& grid, const Split& split,
               Reference* left, Reference* right) {
    const int axis = split.axis;
    const float origin = grid.origin[axis], scale = grid.scale[axis],
                limit = Grid::kZero + float(split.lastLeft);
    for (uint32_t i = 0; i < count; ++i) {
        const Reference& reference = references[i];
        const bool isRight = (reference.centroid(axis) - origin) * scale + Grid::kRound > limit;
        // No branch: which side is next is anyone's guess.
        Reference* const to = isRight ? right : left;
        BoxV::load(floats(&reference)).store(reinterpret_cast<float*>(to));
        right += isRight;
        left += !isRight;
    }
}

class BinnedSplitter {
  public:
    /// `bins` per axis; 0 = by the number of references.
    explicit BinnedSplitter(uint32_t bins) : bins_(bins) {}

    bool split(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        // Boxes without area, on a line or a point, have no SAH to go by.
        if (!(range.bounds.halfArea() > std::numeric_limits<float>::min())) return false;
        const uint32_t bins = bins_ == 0 ? defaultBins(range.count) : bins_;
        const auto splitOver = [&](const Grid& grid) {
            return parallel ? splitInChunks(references, range, grid, left, right)
                            : splitAlone(references, range, grid, left, right);
        };
        return splitOver(Grid(range.bounds, 2, bins)) ||
               splitOver(Grid(centroidBounds(references.at(range), range.count), 1, bins));
    }

  private:
    static bool splitAlone(const ReferenceArrays& references, const Range& range, const Grid& grid,
                           Range& left, Range& right) {
        const Reference* source = references.at(range);
        Reference* target = references.opposite(range);
        Bins bins;
        fillBins(source, range.count, grid, bins);
        const Split best = bestSplit(bins, range.count);
        if (best.axis < 0) return false;
        describeSides(bins, best, left, right);
        partition(source, range.count, grid, best, target, target + left.count);
        return true;
    }

    static bool splitInChunks(const ReferenceArrays& references, const Range& range, const Grid& grid,
                              Range& left, Range& right) {
        const Reference* source = references.at(range);
        Reference* target = references.opposite(range);
        Buffer<Bins> chunks((range.count + kGrain - 1) / kGrain);
        parallelChunks(range.count, kGrain, [&](size_t begin, size_t end) {
            fillBins(source + begin, uint32_t(end - begin), grid, chunks[begin / kGrain]);
        });
        Bins bins;
        bins.clear(grid.bins);
        for (size_t i = 0; i < chunks.size(); ++i) bins.merge(chunks[i]);
        const Split best = bestSplit(bins, range.count);
        if (best.axis < 0) return false;
        describeSides(bins, best, left, right);

        // How many go left before each chunk: the chunks' bins know.
        std::vector<uint32_t> leftsBefore(chunks.size());
        uint32_t lefts = 0;
        for (size_t i = 0; i < chunks.size(); ++i) {
            leftsBefore[i] = lefts;
            const uint32_t* counts = chunks[i].counts + best.axis * grid.bins;
            for (uint32_t bin = 0; bin <= best.lastLeft; ++bin) lefts += counts[bin];
        }
        parallelChunks(range.count, kGrain, [&](size_t begin, size_t end) {
            const uint32_t before = leftsBefore[begin / kGrain];
            partition(source + begin, uint32_t(end - begin), grid, best, target + before,
                      target + left.count + (begin - before));
        });
        return true;
    }

    /// Bounds and counts of both sides, from the bins.
    static void describeSides(const Bins& bins, const Split& split, Range& left, Range& right) {
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

    uint32_t bins_;
};

Bvh build(const Scene& scene, const BuildOptions& options) {
    const BinnedSplitter splitter(options.bins);
    return TopDownBuild<BinnedSplitter>(scene, options, splitter).build();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(build);

Bvh buildBinned(const Scene& scene, const BuildOptions& options) {
    if (options.bins == 1 || options.bins > kMaxBins)
        throw Error(ErrorKind::usage, "bins must be from 2 to " + std::to_string(kMaxBins));
    return HWY_DYNAMIC_DISPATCH(build)(scene, options);
}

}  // namespace bvhio
#endif
