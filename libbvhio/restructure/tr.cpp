// Treelet restructuring (Karras and Aila 2013, "Fast parallel construction of high-quality bounding volume
// hierarchies"): dynamic programming over all subsets of a treelet's leaves finds the tree of least SAH cost
// over them. As in the paper a subset may become a leaf of the final tree where that is cheaper, here within
// the limit on leaf sizes. Departures:
//
// - In the paper the threads of a warp share the subsets of one treelet. Here a vector holds the subsets that
//   differ only in their lowest leaves.
// - The best split of a subset is not stored. It is found again for the few subsets that a better tree
//   contains.

#include "restructure/tr.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "restructure/tr.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Row = hn::CappedTag<float, 8>;
using RowI = hn::RebindToSigned<Row>;
using RowV = hn::Vec<Row>;
using RowIndices = decltype(hn::IndicesFromVec(Row(), hn::Zero(RowI())));

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A subset is a mask of leaves. A row holds the kRow subsets that differ only in the lowest kLow leaves,
// which are the number of the lane.
constexpr uint32_t kRow = std::min<uint32_t>(HWY_MAX_BYTES / sizeof(float), 8), kLow = std::countr_zero(kRow);
constexpr uint32_t kSets = 1u << kLargestOptimalTreelet, kRows = kSets / kRow;

/// The intersection of each lane's subset with each set of low leaves, as indices of lanes.
struct Lanes {
    RowIndices within[kRow];

    Lanes() {
        const RowI di;
        for (uint32_t set = 0; set < kRow; ++set)
            within[set] = hn::IndicesFromVec(Row(), hn::And(hn::Iota(di, 0), hn::Set(di, int32_t(set))));
    }
    HWY_INLINE RowV common(RowV row, uint32_t set) const { return hn::TableLookupLanes(row, within[set]); }
};

/// The cost of each subset as an inner node, without the nodes below it, and as a leaf.
struct SetCosts {
    alignas(64) float inner[kSets];
    alignas(64) float whole[kSets];
    bool leavesForm;  // if not, `whole` is not set

    SetCosts(const Treelet& treelet, const TreeletCosts& costs) {
        const Row d;
        const RowI di;
        // The two leaves with the fewest references decide whether any two may form a leaf.
        float fewest = kInfinity, second = kInfinity;
        for (uint32_t i = 0; i < treelet.size; ++i) {
            second = std::min(second, std::max(fewest, treelet.references[i]));
            fewest = std::min(fewest, treelet.references[i]);
        }
        leavesForm = fewest + second <= costs.maxLeafSize;

        // The boxes and references of the sets of low leaves, one in each lane.
        RowV lowBoxes[6], lowReferences = hn::Zero(d);
        for (RowV& side : lowBoxes) side = hn::Set(d, -kInfinity);
        for (uint32_t i = 0; i < std::min(kLow, treelet.size); ++i) {
            const auto has = hn::RebindMask(d, hn::TestBit(hn::Iota(di, 0), hn::Set(di, 1 << i)));
            for (int side = 0; side < 6; ++side)
                lowBoxes[side] = hn::IfThenElse(
                    has, hn::Max(lowBoxes[side], hn::Set(d, treelet.boxes[side][i])), lowBoxes[side]);
            lowReferences =
                hn::Add(lowReferences, hn::IfThenElseZero(has, hn::Set(d, treelet.references[i])));
        }

        // Row by row: unite these with the high leaves of the row.
        float boxes[kRows][6], references[kRows];
        std::fill_n(boxes[0], 6, -kInfinity);
        references[0] = 0;
        const RowV traversal = hn::Set(d, costs.traversal), intersection = hn::Set(d, costs.intersection),
                   most = hn::Set(d, costs.maxLeafSize), infinity = hn::Set(d, kInfinity);
        const uint32_t rows = treelet.size > kLow ? 1u << (treelet.size - kLow) : 1;
        for (uint32_t row = 0; row < rows; ++row) {
            if (row != 0) {
                const uint32_t rest = row & (row - 1), leaf = kLow + uint32_t(std::countr_zero(row));
                for (int side = 0; side < 6; ++side)
                    boxes[row][side] = std::max(boxes[rest][side], treelet.boxes[side][leaf]);
                references[row] = references[rest] + treelet.references[leaf];
            }
            RowV extents[3];
            for (int axis = 0; axis < 3; ++axis)
                extents[axis] = hn::Add(hn::Max(lowBoxes[axis], hn::Set(d, boxes[row][axis])),
                                        hn::Max(lowBoxes[axis + 3], hn::Set(d, boxes[row][axis + 3])));
            const RowV area = hn::Add(hn::Mul(extents[0], hn::Add(extents[1], extents[2])),
                                      hn::Mul(extents[1], extents[2]));
            hn::Store(hn::Mul(traversal, area), d, inner + row * kRow);
            if (!leavesForm) continue;
            const RowV count = hn::Add(lowReferences, hn::Set(d, references[row]));
            hn::Store(
                hn::IfThenElse(hn::Le(count, most), hn::Mul(hn::Mul(intersection, area), count), infinity), d,
                whole + row * kRow);
        }
        // The empty set has an infinite area and no references.
        inner[0] = whole[0] = kInfinity;
    }

    /// Returns the costs of a row's subsets, if the two parts of each cost `parts` together.
    HWY_INLINE RowV of(uint32_t row, RowV parts) const {
        const Row d;
        const RowV split = hn::Add(hn::Load(d, inner + row * kRow), parts);
        return leavesForm ? hn::Min(split, hn::Load(d, whole + row * kRow)) : split;
    }
};

/// The least costs of all subsets.
class Optimum {
  public:
    Optimum(const Treelet& treelet, const SetCosts& setCosts) {
        const Row d;
        firstRow(treelet, setCosts);
        const RowV first = hn::Load(d, costs_);
        RowV firsts[kRow];
        for (uint32_t low = 1; low < kRow; ++low) firsts[low] = lanes_.common(first, low);
        const uint32_t rows = treelet.size > kLow ? 1u << (treelet.size - kLow) : 1;
        for (uint32_t row = 1; row < rows; ++row) {
            // Splits where both parts have high leaves. The first part has the lowest of them, so that mirror
            // images are tried once.
            const uint32_t lowest = row & (0 - row), rest = row ^ lowest;
            RowV parts = hn::Set(d, kInfinity);
            for (uint32_t others = rest; others != 0;) {
                others = (others - 1) & rest;
                const float *a = spread_[others | lowest][0], *b = spread_[rest ^ others][0];
                RowV sums = hn::Add(hn::Load(d, a), hn::Load(d, b + (kRow - 1) * kRow));
                for (uint32_t low = 1; low < kRow; ++low)
                    sums = hn::Min(
                        sums, hn::Add(hn::Load(d, a + low * kRow), hn::Load(d, b + (kRow - 1 - low) * kRow)));
                parts = hn::Min(parts, sums);
            }
            // Splits where one part has all the high leaves and some of the low ones. Each step finishes the
            // subsets with one more low leaf.
            RowV costs = setCosts.of(row, parts);
            if (rest == 0)
                costs =
                    hn::IfThenElse(hn::FirstN(d, 1),
                                   hn::Set(d, treelet.costs[kLow + uint32_t(std::countr_zero(row))]), costs);
            const RowV alone = lanes_.common(costs, 0);
            parts = hn::Min(parts, hn::Add(first, alone));
            costs = finish(row, rest, parts, alone, setCosts);
            for (uint32_t size = 1; size < kLow; ++size) {
                for (uint32_t low = 1; low < kRow - 1; ++low)
                    if (uint32_t(std::popcount(low)) == size)
                        parts = hn::Min(parts, hn::Add(firsts[kRow - 1 - low], lanes_.common(costs, low)));
                costs = finish(row, rest, parts, alone, setCosts);
            }
            hn::Store(costs, d, costs_ + row * kRow);
            for (uint32_t low = 0; low < kRow; ++low)
                hn::Store(lanes_.common(costs, low), d, spread_[row][low]);
        }
    }

    float cost(uint32_t set) const { return costs_[set]; }

    /// Returns the part of a subset's best split that contains the subset's lowest leaf.
    uint32_t split(uint32_t set) const {
        const uint32_t lowest = set & (0 - set), rest = set ^ lowest;
        uint32_t best = 0;
        float bestCost = kInfinity;
        for (uint32_t others = rest; others != 0;) {
            others = (others - 1) & rest;
            const float cost = costs_[others | lowest] + costs_[rest ^ others];
            if (cost < bestCost) {
                bestCost = cost;
                best = others | lowest;
            }
        }
        return best;
    }

  private:
    /// Computes the costs of subsets of the low leaves alone.
    void firstRow(const Treelet& treelet, const SetCosts& setCosts) {
        const Row d;
        std::fill_n(costs_, kRow, kInfinity);
        for (uint32_t i = 0; i < std::min(kLow, treelet.size); ++i) costs_[1u << i] = treelet.costs[i];
        const RowV leaves = hn::Load(d, costs_);
        RowV costs = leaves;
        for (uint32_t size = 1; size < kLow; ++size) {
            RowV parts = hn::Set(d, kInfinity);
            for (uint32_t low = 1; low < kRow - 1; ++low)
                parts =
                    hn::Min(parts, hn::Add(lanes_.common(costs, low), lanes_.common(costs, kRow - 1 - low)));
            costs = hn::IfThenElse(hn::Lt(leaves, hn::Set(d, kInfinity)), leaves, setCosts.of(0, parts));
        }
        // The empty set keeps an infinite cost, since it cannot be a part.
        hn::Store(hn::IfThenElse(hn::FirstN(d, 1), hn::Set(d, kInfinity), costs), d, costs_);
    }

    static HWY_INLINE RowV finish(uint32_t row, uint32_t rest, RowV parts, RowV alone,
                                  const SetCosts& setCosts) {
        const Row d;
        const RowV costs = setCosts.of(row, parts);
        return rest == 0 ? hn::IfThenElse(hn::FirstN(d, 1), alone, costs) : costs;
    }

    const Lanes lanes_;
    alignas(64) float costs_[kSets];
    alignas(64) float spread_[kRows][kRow][kRow];  // costs of the lanes' intersections with each low set
};

class PlanWriter {
  public:
    PlanWriter(const Optimum& optimum, uint32_t size, TreeletPlan& plan)
        : optimum_(optimum), size_(size), plan_(plan) {}

    uint32_t write(uint32_t set) {
        if ((set & (set - 1)) == 0) return uint32_t(std::countr_zero(set));
        const uint32_t part = optimum_.split(set);
        const uint32_t left = write(part), right = write(set ^ part);
        plan_.left[step_] = uint8_t(left);
        plan_.right[step_] = uint8_t(right);
        return size_ + step_++;
    }

  private:
    const Optimum& optimum_;
    const uint32_t size_;
    TreeletPlan& plan_;
    uint32_t step_ = 0;
};

bool plan(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& result) {
    const SetCosts setCosts(treelet, costs);
    const Optimum optimum(treelet, setCosts);
    const uint32_t all = (1u << treelet.size) - 1;
    if (!(optimum.cost(all) < limit)) return false;
    PlanWriter(optimum, treelet.size, result).write(all);
    return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(plan);

bool planOptimally(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& result) {
    return HWY_DYNAMIC_DISPATCH(plan)(treelet, costs, limit, result);
}

Restructured restructureTr(const Scene& scene, const Bvh& bvh, const RestructureOptions& options) {
    return restructureTreelets(scene, bvh, options, {7, kLargestOptimalTreelet, 3, 1, planOptimally});
}

}  // namespace bvhio
#endif
