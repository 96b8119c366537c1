// Branch and bound as in Meister and Bittner 2018, 3.1: the search goes from the moved node up to the root,
// and from each ancestor down into its other child. On the way down an upper bound of the gain at places
// below a node y is known: the area that the removal frees, minus the growth of the ancestors of y and of y
// itself, minus the moved node's own area.

#include "restructure/reinsertion_search.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "restructure/reinsertion_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourV = hn::Vec<Four>;

/// The most pairs that a search looks at on its way down, and the most levels on its way up. Typical are
/// about ten of each.
constexpr uint32_t kMaxPairs = 2048, kMaxLevels = 256;
/// A gain less than this fraction of the freed area may be rounding.
constexpr float kLeastGain = 1e-6f;

struct BoxV {
    FourV low, high;

    /// Loads and scales a box at once, since an extent may exceed a float. The fourth lane of `low` holds
    /// whatever follows in memory. That of `high` is zero: integers would be denormals there.
    static HWY_INLINE BoxV load(const Node& node, FourV scale) {
        const Four d;
        alignas(16) static constexpr uint32_t kThree[4] = {~0u, ~0u, ~0u, 0};
        const float* lanes = &node.bounds.min.x;
        const FourV three = hn::BitCast(d, hn::Load(hn::RebindToUnsigned<Four>(), kThree));
        return {hn::Mul(hn::Load(d, lanes), scale), hn::Mul(hn::And(hn::LoadU(d, lanes + 3), three), scale)};
    }
    friend HWY_INLINE BoxV unite(BoxV a, BoxV b) { return {hn::Min(a.low, b.low), hn::Max(a.high, b.high)}; }
    HWY_INLINE FourV extent() const { return hn::Sub(high, low); }
};

/// Computes the half areas of four boxes.
HWY_INLINE void halfAreas(BoxV a, BoxV b, BoxV c, BoxV e, float* areas) {
    const Four d;
    const FourV ea = a.extent(), eb = b.extent(), ec = c.extent(), ee = e.extent();
    const FourV lower0 = hn::InterleaveLower(d, ea, eb), lower1 = hn::InterleaveLower(d, ec, ee);
    const FourV upper0 = hn::InterleaveUpper(d, ea, eb), upper1 = hn::InterleaveUpper(d, ec, ee);
    const FourV x = hn::ConcatLowerLower(d, lower1, lower0);
    const FourV y = hn::ConcatUpperUpper(d, lower1, lower0);
    const FourV z = hn::ConcatLowerLower(d, upper1, upper0);
    hn::Store(hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x)), d, areas);
}

class Search {
  public:
    Search(const TreeEditor& tree, float scale)
        : tree_(tree), nodes_(&tree[0]), scale_(hn::Set(Four(), scale)) {}

    /// Finds the best place for a subtree.
    HWY_INLINE Place find(uint32_t moved) {
        const uint32_t parent = tree_.parent(moved), sibling = tree_.sibling(moved);
        moved_ = load(nodes_[moved]);
        BoxV left = load(nodes_[sibling]);  // the current ancestor's box without the moved node
        alignas(16) float areas[4];
        halfAreas(moved_, left, load(nodes_[parent]), left, areas);
        movedArea_ = areas[0];
        float removed = areas[2];  // the area that removing the node frees
        best_ = {removed * kLeastGain, 0};
        pairsLeft_ = kMaxPairs;
        if (!nodes_[sibling].isLeaf()) descend(nodes_[sibling].left(), areas[1]);

        // Climb to the root, as long as ancestors shrink or a gain is still possible.
        bool shrinks = true;
        uint32_t at = parent;
        for (uint32_t level = 0; at != 0 && level < kMaxLevels && pairsLeft_ != 0; ++level) {
            const uint32_t other = tree_.sibling(at);
            const bool worthwhile = removed - movedArea_ > best_.gain;
            if (!shrinks && !worthwhile) break;
            at = tree_.parent(at);
            const BoxV box = load(nodes_[other]), above = load(nodes_[at]);
            left = unite(left, box);
            halfAreas(box, unite(box, moved_), above, left, areas);
            if (worthwhile) {
                const float gain = removed - areas[1];
                consider(gain, other);
                if (!nodes_[other].isLeaf()) descend(nodes_[other].left(), gain + areas[0]);
            }
            if (shrinks) {
                removed += areas[2] - areas[3];
                const Four d;
                const auto same = hn::And(hn::Eq(left.low, above.low), hn::Eq(left.high, above.high));
                alignas(16) static constexpr uint32_t kFourth[4] = {0, 0, 0, ~0u};
                const auto fourth = hn::Load(hn::RebindToUnsigned<Four>(), kFourth);
                shrinks = !hn::AllTrue(d, hn::Or(same, hn::MaskFromVec(hn::BitCast(d, fourth))));
            }
        }
        return best_.beside != 0 ? best_ : Place();
    }

  private:
    HWY_INLINE BoxV load(const Node& node) const { return BoxV::load(node, scale_); }

    struct Open {
        float bound;
        uint32_t pair;
    };

    HWY_INLINE void consider(float gain, uint32_t beside) {
        if (gain > best_.gain) best_ = {gain, beside};
    }

    /// Looks at the places below a node with children `pair`. `bound` is the freed area minus the growth of
    /// the nodes above the pair.
    HWY_INLINE void descend(uint32_t pair, float bound) {
        if (!(bound - movedArea_ > best_.gain)) return;
        uint32_t open = 0;
        while (pairsLeft_ != 0) {
            --pairsLeft_;
            const BoxV a = load(nodes_[pair]), b = load(nodes_[pair + 1]);
            alignas(16) float areas[4];
            halfAreas(a, unite(a, moved_), b, unite(b, moved_), areas);
            const float gainA = bound - areas[1], gainB = bound - areas[3];
            consider(gainA, pair);
            consider(gainB, pair + 1);
            const float least = best_.gain + movedArea_;
            Open first = openBelow(pair, gainA + areas[0]), second = openBelow(pair + 1, gainB + areas[2]);
            if (first.bound < second.bound) std::swap(first, second);
            if (second.bound > least) open_[open++] = second;
            while (!(first.bound > least)) {
                if (open == 0) return;
                first = open_[--open];
            }
            bound = first.bound;
            pair = first.pair;
        }
    }
    HWY_INLINE Open openBelow(uint32_t index, float bound) const {
        const Node& node = nodes_[index];
        return {node.isLeaf() ? -1.0f : bound, node.first};
    }

    const TreeEditor& tree_;
    const Node* const nodes_;
    const FourV scale_;
    BoxV moved_{};
    float movedArea_ = 0;
    Place best_;
    uint32_t pairsLeft_ = 0;
    Open open_[kMaxPairs];
};

void findSome(const TreeEditor& tree, float scale, std::span<const uint32_t> nodes, Place* places) {
    Search search(tree, scale);
    for (size_t i = 0; i < nodes.size(); ++i) places[i] = search.find(nodes[i]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(findSome);

}  // namespace

void findPlaces(const TreeEditor& tree, float scale, std::span<const uint32_t> nodes, Place* places) {
    HWY_DYNAMIC_DISPATCH(findSome)(tree, scale, nodes, places);
}

}  // namespace bvhio
#endif
