// Binned SAH (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"): centroids fall
// into equal bins along each axis, and the best plane between bins, by the SAH, splits the node. Departures:
//
// - The bins span the node's box rather than the box of its centroids. This saves a pass and, at 16 bins,
//   costs up to about 1% of quality. If all centroids share a bin, the bins span the box of the centroids.
// - All axes are binned in one pass, and the widest nodes by all threads, in chunks. Partitions keep order,
//   so that the result does not depend on the chunks.
// - Ranges of a few primitives are solved exactly (small_tree).
// - Leaves are decided bottom-up (top_down).

#include "build/binned.h"

#include <string>

#include "build/top_down.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/binned.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/object_split_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Trees over boxes of subtrees gain from more bins than trees over triangles, and have few boxes to bin.
constexpr uint32_t kBinsOver = 32;

class BinnedSplitter {
  public:
    /// `bins` per axis; 0 = by the number of references.
    explicit BinnedSplitter(uint32_t bins) : bins_(bins) {}

    bool split(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        ObjectSplit best;
        if (!findObjectSplit(references, range, bins_, parallel, best, left, right)) return false;
        moveReferences(references, range, best, right.count, parallel);
        return true;
    }

  private:
    uint32_t bins_;
};

Bvh build(const Scene& scene, const BuildOptions& options) {
    BinnedSplitter splitter(options.bins);
    return TopDownBuild<BinnedSplitter>(options, splitter).build(scene);
}

Bvh buildOver(Buffer<Reference>& references, const Box& bounds, const SahCosts& costs) {
    BinnedSplitter splitter(kBinsOver);
    const auto count = uint32_t(references.size());
    return TopDownBuild<BinnedSplitter>({.costs = costs, .maxLeafSize = 1}, splitter)
        .build(std::move(references), count, bounds);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(build);
HWY_EXPORT(buildOver);

void checkBins(const BuildOptions& options) {
    if (options.bins == 1 || options.bins > kMaxBins)
        throw Error(ErrorKind::usage, "the number of bins must be from 2 to " + std::to_string(kMaxBins));
}

Bvh buildBinned(const Scene& scene, const BuildOptions& options) {
    checkBins(options);
    return HWY_DYNAMIC_DISPATCH(build)(scene, options);
}

Bvh buildBinnedOver(Buffer<Reference> references, const Box& bounds, const SahCosts& costs) {
    return HWY_DYNAMIC_DISPATCH(buildOver)(references, bounds, costs);
}

}  // namespace bvhio
#endif
