// Agglomerative treelet restructuring (Domingues and Pedrini 2015, "Bounding volume hierarchy optimization
// through agglomerative treelet restructuring"): the leaves of a treelet are joined from the bottom up, nodes
// near each other first. If the resulting tree costs less, it replaces the treelet. Departures:
//
// - The paper's distance of two nodes is the area of their union. Our distance subtracts half of their own
//   areas, which favours nodes that fit together over small ones. Trees from lbvh become up to 3% cheaper,
//   and never much more expensive.
// - The paper joins the nearest pair and keeps all distances in a triangular matrix. Here each round joins
//   all nodes that are nearest to each other, as in PLOC (Meister and Bittner 2018), and computes distances
//   anew, a row of them at a time. Nothing is stored, and a round takes hardly longer than one step did. With
//   the paper's distance, which no union makes shorter, the tree would be the same.
// - A subset counts as a leaf of the final tree if that is cheaper, as in Karras and Aila 2013. In the paper
//   leaves form only at the end, when earlier gains may turn out not to be gains.
// - The few nodes with at least 512 references are visited up to three times in an iteration, children before
//   parents. This lowers the cost by up to another 2%.

#include "restructure/atr.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "restructure/atr.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Row = hn::CappedTag<float, 16>;
using RowI = hn::RebindToSigned<Row>;
using RowV = hn::Vec<Row>;
constexpr uint32_t kRow = std::min<uint32_t>(HWY_MAX_BYTES / sizeof(float), 16);

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The nodes without a parent so far, each in the slot of its first leaf.
class Clusters {
  public:
    Clusters(const Treelet& treelet, const TreeletCosts& costs)
        : costs_(costs), size_(treelet.size), alive_((1u << treelet.size) - 1) {
        const Row d;
        const RowI di;
        for (uint32_t i = 0; i < size_; i += kRow) {
            RowV sides[6];
            for (int side = 0; side < 6; ++side) {
                sides[side] = hn::Load(d, treelet.boxes[side] + i);
                hn::Store(sides[side], d, boxes_[side] + i);
            }
            const RowV x = hn::Add(sides[0], sides[3]), y = hn::Add(sides[1], sides[4]),
                       z = hn::Add(sides[2], sides[5]);
            hn::Store(hn::Mul(hn::Set(d, 0.5f), areaOf(x, y, z)), d, halves_ + i);
            hn::Store(hn::Load(d, treelet.costs + i), d, below_ + i);
            hn::Store(hn::Load(d, treelet.references + i), d, references_ + i);
            hn::Store(hn::Iota(di, int32_t(i)), di, nodes_ + i);
        }
    }

    /// Joins nodes until one is left, and returns its cost.
    float joinAll(TreeletPlan& plan) {
        while (std::popcount(alive_) > 2) {
            findNearest();
            // Without branches, which would often be mispredicted.
            uint32_t firsts = 0;
            for (uint32_t a = 0; a < size_; ++a) {
                const auto b = uint32_t(nearest_[a]);
                firsts |= uint32_t((a < b) & (uint32_t(nearest_[b]) == a)) << a;
            }
            for (; firsts != 0; firsts &= firsts - 1) {
                const auto a = uint32_t(std::countr_zero(firsts));
                join(a, uint32_t(nearest_[a]), plan);
            }
        }
        // The last join needs no search. Slot 0 is always in use, since a join keeps the first of its two
        // slots.
        join(0, uint32_t(std::countr_zero(alive_ ^ 1)), plan);
        return below_[0];
    }

  private:
    static HWY_INLINE RowV areaOf(RowV x, RowV y, RowV z) {
        return hn::Add(hn::Mul(x, hn::Add(y, z)), hn::Mul(y, z));
    }

    /// Finds for each node the nearest other one; of equally near ones, the first. So of all nearest pairs,
    /// the first is always mutual.
    void findNearest() {
        const Row d;
        const RowI di;
        for (uint32_t i = 0; i < size_; i += kRow) {
            RowV sides[6];
            for (int side = 0; side < 6; ++side) sides[side] = hn::Load(d, boxes_[side] + i);
            const RowV halves = hn::Load(d, halves_ + i);
            const auto slots = hn::Iota(di, int32_t(i));
            RowV least = hn::Set(d, kInfinity);
            auto nearest = hn::Zero(di);
            for (uint32_t open = alive_; open != 0; open &= open - 1) {
                const auto other = std::countr_zero(open);
                RowV extents[3];
                for (int axis = 0; axis < 3; ++axis)
                    extents[axis] = hn::Add(hn::Max(sides[axis], hn::Set(d, boxes_[axis][other])),
                                            hn::Max(sides[axis + 3], hn::Set(d, boxes_[axis + 3][other])));
                const RowV distance = hn::Sub(areaOf(extents[0], extents[1], extents[2]),
                                              hn::Add(halves, hn::Set(d, halves_[other])));
                const auto otherV = hn::Set(di, other);
                const auto nearer =
                    hn::AndNot(hn::RebindMask(d, hn::Eq(slots, otherV)), hn::Lt(distance, least));
                least = hn::IfThenElse(nearer, distance, least);
                nearest = hn::IfThenElse(hn::RebindMask(di, nearer), otherV, nearest);
            }
            hn::Store(nearest, di, nearest_ + i);
        }
    }

    /// Joins the nodes in slots a and b into a node in slot a.
    void join(uint32_t a, uint32_t b, TreeletPlan& plan) {
        for (auto& side : boxes_) side[a] = std::max(side[a], side[b]);
        const float x = boxes_[0][a] + boxes_[3][a], y = boxes_[1][a] + boxes_[4][a],
                    z = boxes_[2][a] + boxes_[5][a];
        const float area = x * (y + z) + y * z;
        references_[a] += references_[b];
        below_[a] = costs_.of(area, references_[a], below_[a], below_[b]);
        halves_[a] = 0.5f * area;
        plan.left[step_] = uint8_t(nodes_[a]);
        plan.right[step_] = uint8_t(nodes_[b]);
        nodes_[a] = int32_t(size_ + step_++);
        alive_ ^= 1u << b;
    }

    const TreeletCosts& costs_;
    const uint32_t size_;
    uint32_t alive_;  // slots in use
    uint32_t step_ = 0;
    alignas(64) float boxes_[6][Treelet::kLanes];
    alignas(64) float halves_[Treelet::kLanes];  // of areas
    alignas(64) float below_[Treelet::kLanes];   // costs of the subtrees
    alignas(64) float references_[Treelet::kLanes];
    alignas(64) int32_t nodes_[Treelet::kLanes];
    alignas(64) int32_t nearest_[Treelet::kLanes];
};

bool plan(const Treelet& treelet, const TreeletCosts& costs, float limit, TreeletPlan& result) {
    return Clusters(treelet, costs).joinAll(result) < limit;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(plan);

bool planByAgglomeration(const Treelet& treelet, const TreeletCosts& costs, float limit,
                         TreeletPlan& result) {
    return HWY_DYNAMIC_DISPATCH(plan)(treelet, costs, limit, result);
}

Restructured restructureAtr(const Scene& scene, const Bvh& bvh, const RestructureOptions& options) {
    return restructureTreelets(scene, bvh, options, {9, kMaxTreeletSize, 2, 3, planByAgglomeration});
}

}  // namespace bvhio
#endif
