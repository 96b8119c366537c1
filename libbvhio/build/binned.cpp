// Binned SAH (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"): centroids fall
// into equal bins along each axis, and the best plane between bins, by the SAH, splits the node. Departures:
// every axis is binned in one pass, and the widest nodes by all threads in chunks; partitions keep order, so
// that the result does not depend on the chunks; ranges of a few primitives are solved exactly (small_tree);
// leaves are decided bottom-up.

#include "build/binned.h"

#include <cstring>

#include "build/top_down.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/binned.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourV = hn::Vec<Four>;

constexpr uint32_t kGrain = 1 << 13;  // references a task bins or moves at a time

/// Maps doubled centroids to bins: bin = round((centroid - origin) * scale - 0.5), exactly the same wherever
/// it is computed. Adding 2^23 - 0.5 rounds to an integer in the low bits of a float.
struct Grid {
    float origin[4], scale[4];
    static constexpr float kRound = 8388607.5f, kZero = 8388608.0f;
};

/// What falls into each bin: 8 floats of a Box and a count per bin, axis by axis.
struct Bins {
    alignas(32) float boxes[3 * kMaxBins][8];
    uint32_t counts[3 * kMaxBins];
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();
    int axis = -1;
    uint32_t lastLeft = 0;  // the last bin of the left side
};

/// Three lanes of a reference's or box's halves; the fourth, an integer perhaps, would be slow to compute
/// with as a denormal.
HWY_INLINE FourV three(const float* p) {
    const Four d;
    return hn::IfThenElseZero(hn::FirstN(d, 3), hn::Load(d, p));
}

HWY_INLINE const float* floats(const Reference* reference) {
    return reinterpret_cast<const float*>(reference);
}

void clearBins(Bins& bins, uint32_t count) {
    const Four d;
    const FourV none = hn::Set(d, -std::numeric_limits<float>::infinity());
    for (uint32_t i = 0; i < 3 * count; ++i) {
        hn::Store(none, d, bins.boxes[i]);
        hn::Store(none, d, bins.boxes[i] + 4);
        bins.counts[i] = 0;
    }
}

void fillBins(const Reference* references, uint32_t count, const Grid& grid, uint32_t binCount, Bins& bins) {
    const Four d;
    const FourV origin = hn::Load(d, grid.origin), scale = hn::Load(d, grid.scale);
    const FourV round = hn::Set(d, Grid::kRound), zero = hn::Set(d, Grid::kZero);
    for (uint32_t i = 0; i < count; ++i) {
        const float* reference = floats(references + i);
        const FourV low = hn::Load(d, reference), high = hn::Load(d, reference + 4);
        const FourV centroid = hn::Sub(three(reference + 4), three(reference));
        alignas(16) uint32_t bin[4];
        const FourV rounded = hn::Max(hn::Add(hn::Mul(hn::Sub(centroid, origin), scale), round), zero);
        hn::Store(hn::BitCast(hn::RebindToUnsigned<Four>(), rounded), hn::RebindToUnsigned<Four>(), bin);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const uint32_t at = axis * binCount + (bin[axis] & 0xFF);
            float* box = bins.boxes[at];
            hn::Store(hn::Max(hn::Load(d, box), low), d, box);
            hn::Store(hn::Max(hn::Load(d, box + 4), high), d, box + 4);
            ++bins.counts[at];
        }
    }
}

void mergeBins(const Bins& from, uint32_t count, Bins& to) {
    const Four d;
    for (uint32_t i = 0; i < 3 * count; ++i) {
        for (int half = 0; half < 8; half += 4)
            hn::Store(hn::Max(hn::Load(d, from.boxes[i] + half), hn::Load(d, to.boxes[i] + half)), d,
                      to.boxes[i] + half);
        to.counts[i] += from.counts[i];
    }
}

HWY_INLINE float halfArea(FourV low, FourV high) {
    const Four d;
    alignas(16) float e[4];
    hn::Store(hn::Add(low, high), d, e);
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

Split bestSplit(const Bins& bins, uint32_t binCount, const Range& range) {
    const Four d;
    const FourV none = hn::Set(d, -std::numeric_limits<float>::infinity());
    Split best;
    float rightCosts[kMaxBins];
    for (int axis = 0; axis < 3; ++axis) {
        if (!(range.centroids.extent(axis) > 0)) continue;
        const float(*boxes)[8] = bins.boxes + axis * binCount;
        const uint32_t* counts = bins.counts + axis * binCount;
        FourV low = none, high = none;
        uint32_t count = 0;
        for (uint32_t i = binCount - 1; i > 0; --i) {
            low = hn::Max(low, hn::Load(d, boxes[i]));
            high = hn::Max(high, hn::Load(d, boxes[i] + 4));
            count += counts[i];
            rightCosts[i] = halfArea(low, high) * float(count);
        }
        low = high = none;
        count = 0;
        for (uint32_t i = 0; i + 1 < binCount; ++i) {
            low = hn::Max(low, hn::Load(d, boxes[i]));
            high = hn::Max(high, hn::Load(d, boxes[i] + 4));
            count += counts[i];
            if (count == 0 || count == range.count) continue;
            const float cost = halfArea(low, high) * float(count) + rightCosts[i + 1];
            if (cost < best.cost) best = {cost, axis, i};
        }
    }
    return best;
}

/// Copies references to the left or right side, in order, and returns the bounds of both sides' centroids.
void partition(const Reference* references, uint32_t count, const Grid& grid, const Split& split,
               Reference* leftTarget, Reference* rightTarget, Box& leftCentroids, Box& rightCentroids) {
    const Four d;
    const int axis = split.axis;
    const float origin = grid.origin[axis], scale = grid.scale[axis],
                limit = Grid::kZero + float(split.lastLeft);
    FourV bounds[2][2];
    for (auto& side : bounds) side[0] = side[1] = hn::Set(d, -std::numeric_limits<float>::infinity());
    for (uint32_t i = 0; i < count; ++i) {
        const Reference& reference = references[i];
        const bool isRight = (reference.centroid(axis) - origin) * scale + Grid::kRound > limit;
        Reference*& target = isRight ? rightTarget : leftTarget;
        *target++ = reference;
        const FourV low = three(floats(&reference)), high = three(floats(&reference) + 4);
        const FourV centroid = hn::Sub(high, low);
        FourV* side = bounds[isRight];
        side[0] = hn::Max(side[0], hn::Neg(centroid));
        side[1] = hn::Max(side[1], centroid);
    }
    hn::Store(bounds[0][0], d, leftCentroids.negatedMin);
    hn::Store(bounds[0][1], d, leftCentroids.max);
    hn::Store(bounds[1][0], d, rightCentroids.negatedMin);
    hn::Store(bounds[1][1], d, rightCentroids.max);
}

class BinnedSplitter {
  public:
    explicit BinnedSplitter(uint32_t bins) : bins_(bins) {}

    bool split(ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        // Boxes without area, on a line or a point, have no SAH to go by.
        if (!(range.bounds.halfArea() > std::numeric_limits<float>::min())) return false;
        Grid grid{};
        bool flat = true;
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = range.centroids.extent(axis);
            grid.origin[axis] = 0 - range.centroids.negatedMin[axis];
            // A little less than all bins, so that rounding cannot reach the one after the last.
            if (extent > std::numeric_limits<float>::min()) {
                grid.scale[axis] = float(bins_) * 0.9999f / extent;
                flat = false;
            }
        }
        if (flat) return false;
        const Reference* source = references.at(range);
        Reference* target = references.opposite(range);

        if (!parallel) {
            Bins bins;
            clearBins(bins, bins_);
            fillBins(source, range.count, grid, bins_, bins);
            const Split best = bestSplit(bins, bins_, range);
            if (best.axis < 0) return false;
            finish(bins, best, left, right);
            partition(source, range.count, grid, best, target, target + left.count, left.centroids,
                      right.centroids);
            return true;
        }

        const uint32_t chunks = (range.count + kGrain - 1) / kGrain;
        std::vector<Bins> chunkBins(chunks);
        parallelChunks(range.count, kGrain, [&](size_t begin, size_t end) {
            Bins& bins = chunkBins[begin / kGrain];
            clearBins(bins, bins_);
            fillBins(source + begin, uint32_t(end - begin), grid, bins_, bins);
        });
        Bins bins;
        clearBins(bins, bins_);
        for (const Bins& chunk : chunkBins) mergeBins(chunk, bins_, bins);
        const Split best = bestSplit(bins, bins_, range);
        if (best.axis < 0) return false;
        finish(bins, best, left, right);

        struct Chunk {
            uint32_t left, right;  // where its first references go
            Box leftCentroids, rightCentroids;
        };
        std::vector<Chunk> moves(chunks);
        uint32_t toLeft = 0, toRight = left.count;
        for (uint32_t i = 0; i < chunks; ++i) {
            moves[i].left = toLeft;
            moves[i].right = toRight;
            const uint32_t size = std::min(kGrain, range.count - i * kGrain);
            uint32_t lefts = 0;
            for (uint32_t b = 0; b <= best.lastLeft; ++b) lefts += chunkBins[i].counts[best.axis * bins_ + b];
            toLeft += lefts;
            toRight += size - lefts;
        }
        parallelChunks(range.count, kGrain, [&](size_t begin, size_t end) {
            Chunk& chunk = moves[begin / kGrain];
            partition(source + begin, uint32_t(end - begin), grid, best, target + chunk.left,
                      target + chunk.right, chunk.leftCentroids, chunk.rightCentroids);
        });
        left.centroids = right.centroids = Box::empty();
        for (const Chunk& chunk : moves) {
            left.centroids.extend(chunk.leftCentroids);
            right.centroids.extend(chunk.rightCentroids);
        }
        return true;
    }

  private:
    /// Bounds and counts of both sides, from the bins.
    void finish(const Bins& bins, const Split& split, Range& left, Range& right) const {
        left.bounds = right.bounds = Box::empty();
        left.count = right.count = 0;
        for (uint32_t i = 0; i < bins_; ++i) {
            Range& side = i <= split.lastLeft ? left : right;
            const uint32_t at = split.axis * bins_ + i;
            Box box;
            std::memcpy(&box, bins.boxes[at], sizeof box);
            side.bounds.extend(box);
            side.count += bins.counts[at];
        }
    }

    uint32_t bins_;
};

Bvh build(const Scene& scene, const BuildOptions& options) {
    const BinnedSplitter splitter(options.bins == 0 ? 16 : options.bins);
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
