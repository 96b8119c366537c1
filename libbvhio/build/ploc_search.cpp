// Each lane of a vector holds another cluster. All lanes look at their partners one distance after another.

#include "build/ploc_search.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/ploc_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

using Lanes = hn::ScalableTag<float>;
using LanesU = hn::RebindToUnsigned<Lanes>;

/// The boxes of a chunk of clusters and of those around it, each coordinate in its own array. Where there are
/// no clusters, boxes are far away.
class Surroundings {
  public:
    Surroundings(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end) {
        const int64_t first = int64_t(begin) - kRadius, last = int64_t(end) + kRadius + kMostLanes;
        const int64_t from = std::max<int64_t>(first, 0), to = std::min<int64_t>(last, count);
        for (auto& numbers : numbers_) {
            std::fill(numbers, numbers + (from - first), kFar);
            std::fill(numbers + (to - first), numbers + (last - first), kFar);
        }
        for (int64_t i = from; i < to; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                numbers_[axis][i - first] = clusters[i].negatedMin[axis];
                numbers_[axis + 3][i - first] = clusters[i].max[axis];
            }
    }

    /// Loads a coordinate of the boxes from place `i` of the chunk on.
    HWY_INLINE hn::Vec<Lanes> load(int number, int64_t i) const {
        return hn::LoadU(Lanes(), numbers_[number] + kRadius + i);
    }

  private:
    static constexpr uint32_t kMostLanes = 64;
    static constexpr float kFar = 0x1p60f;
    alignas(64) float numbers_[6][kSearchGrain + 2 * kRadius + kMostLanes];
};

void findNearestSimd(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end,
                     uint8_t* nearest) {
    const Lanes d;
    const LanesU du;
    using V = hn::Vec<Lanes>;
    using VU = hn::Vec<LanesU>;
    const Surroundings boxes(clusters, count, begin, end);
    const auto lanes = uint32_t(hn::Lanes(d));
    const VU one = hn::Set(du, 1), distance = hn::Set(du, ~(kPartners - 1));
    for (uint32_t i = 0; begin + i < end; i += lanes) {
        const V x0 = boxes.load(0, i), y0 = boxes.load(1, i), z0 = boxes.load(2, i), x1 = boxes.load(3, i),
                y1 = boxes.load(4, i), z1 = boxes.load(5, i);
        // The area of the common box, with the partner's number in its lowest bits.
        const auto rate = [&](int64_t j, VU partner) HWY_ATTR {
            const V x = hn::Add(hn::Max(x0, boxes.load(0, j)), hn::Max(x1, boxes.load(3, j)));
            const V y = hn::Add(hn::Max(y0, boxes.load(1, j)), hn::Max(y1, boxes.load(4, j)));
            const V z = hn::Add(hn::Max(z0, boxes.load(2, j)), hn::Max(z1, boxes.load(5, j)));
            const V area = hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
            return hn::Or(hn::And(hn::BitCast(du, area), distance), partner);
        };
        VU least = hn::Set(du, ~0u);
        const VU places = hn::Iota(du, begin + i);
        for (uint32_t k = 1; k <= kRadius; ++k) {
            const VU side = hn::And(hn::ShiftRightSame(places, std::countr_zero(k)), one);
            const VU after = hn::Or(side, hn::Set(du, 2 * (k - 1)));
            least = hn::Min(least, rate(int64_t(i) + k, after));
            least = hn::Min(least, rate(int64_t(i) - k, hn::Xor(after, one)));
        }
        alignas(64) uint32_t found[64];
        hn::Store(least, du, found);
        for (uint32_t lane = 0; lane < std::min(end - begin - i, lanes); ++lane)
            nearest[begin + i + lane] = uint8_t(found[lane] % kPartners);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(findNearestSimd);

void findNearest(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end, uint8_t* nearest) {
    HWY_DYNAMIC_DISPATCH(findNearestSimd)(clusters, count, begin, end, nearest);
}

}  // namespace bvhio
#endif
