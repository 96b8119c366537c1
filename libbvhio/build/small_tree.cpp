// Dynamic programming over all subsets of the primitives: four primitives have 15 subsets, and 25 ways to
// split them. A subset is a mask.

#include "build/small_tree.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/small_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourV = hn::Vec<Four>;

constexpr uint32_t kSets = 1 << kSmallTree;
constexpr uint8_t kSize[kSets] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/// Computes the boxes and half areas of all subsets.
void measure(const Reference* references, uint32_t count, Box* bounds, float* areas) {
    const Four d;
    alignas(16) float extents[kSets][4];
    hn::Store(hn::Zero(d), d, extents[0]);
    for (uint32_t i = 0; i < count; ++i) {
        const auto* lanes = reinterpret_cast<const float*>(references + i);
        const FourV low = hn::Load(d, lanes), high = hn::Load(d, lanes + 4);
        const uint32_t single = 1u << i;
        hn::Store(low, d, bounds[single].negatedMin);
        hn::Store(high, d, bounds[single].max);
        hn::Store(hn::Add(low, high), d, extents[single]);
        for (uint32_t rest = 1; rest < single; ++rest) {
            const FourV lows = hn::Max(low, hn::Load(d, bounds[rest].negatedMin));
            const FourV highs = hn::Max(high, hn::Load(d, bounds[rest].max));
            hn::Store(lows, d, bounds[single | rest].negatedMin);
            hn::Store(highs, d, bounds[single | rest].max);
            hn::Store(hn::Add(lows, highs), d, extents[single | rest]);
        }
    }
    for (uint32_t set = 0; set < 1u << count; set += 4) {
        FourV x, y, z, unused;
        hn::LoadInterleaved4(d, extents[set], x, y, z, unused);
        hn::Store(hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x)), d, areas + set);
    }
}

/// The best tree over each subset: its cost, and the subset that goes left (0 for a leaf).
struct Plans {
    float costs[kSets];
    uint8_t lefts[kSets];
};

template <uint32_t kCount>
void plan(const float* areas, const LeafRule& rule, Plans& plans) {
    for (uint32_t set = 1; set < 1u << kCount; ++set) {
        const uint32_t lowest = set & (0 - set), rest = set ^ lowest;
        const float leafCost = rule.cost(areas[set], kSize[set]);
        if (rest == 0) {
            plans.costs[set] = leafCost;
            plans.lefts[set] = 0;
            continue;
        }
        // The left side always has the lowest primitive, so that mirror images are tried once.
        float best = plans.costs[lowest] + plans.costs[rest];
        uint32_t bestLeft = lowest;
        for (uint32_t others = (rest - 1) & rest; others != 0; others = (others - 1) & rest) {
            const uint32_t left = others | lowest;
            const float cost = plans.costs[left] + plans.costs[set ^ left];
            const bool better = cost < best;
            best = better ? cost : best;
            bestLeft = better ? left : bestLeft;
        }
        const float splitCost = best + rule.traversal * areas[set];
        const bool leaf = kSize[set] <= rule.maxLeafSize && leafCost <= splitCost;
        plans.costs[set] = leaf ? leafCost : splitCost;
        plans.lefts[set] = uint8_t(leaf ? 0 : bestLeft);
    }
}

/// Writes the planned tree over a subset.
struct Writer {
    const Reference* references;
    const Box* bounds;
    const Plans& plans;
    Node* nodes;
    uint32_t& nodeCount;
    uint32_t* primitives;
    uint32_t nextPrimitive;

    void write(uint32_t set, Node& node) {
        const uint32_t left = plans.lefts[set];
        if (left == 0) {
            node = {bounds[set].toAabb(), nextPrimitive, kSize[set]};
            for (uint32_t i = 0; i < kSmallTree; ++i)
                if (set >> i & 1) primitives[nextPrimitive++] = references[i].primitive;
            return;
        }
        const uint32_t pair = nodeCount;
        nodeCount += 2;
        node = {bounds[set].toAabb(), pair, 0};
        write(left, nodes[pair]);
        write(set ^ left, nodes[pair + 1]);
    }
};

float build(const Reference* references, uint32_t count, const LeafRule& rule, Node& node, Node* nodes,
            uint32_t& nodeCount, uint32_t* primitives, uint32_t begin) {
    Box bounds[kSets];
    alignas(16) float areas[kSets];
    measure(references, count, bounds, areas);
    Plans plans;
    switch (count) {
        case 1:
            plan<1>(areas, rule, plans);
            break;
        case 2:
            plan<2>(areas, rule, plans);
            break;
        case 3:
            plan<3>(areas, rule, plans);
            break;
        default:
            plan<4>(areas, rule, plans);
    }
    const uint32_t all = (1u << count) - 1;
    Writer{references, bounds, plans, nodes, nodeCount, primitives, begin}.write(all, node);
    return plans.costs[all];
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(build);

float buildSmallTree(const Reference* references, uint32_t count, const LeafRule& rule, Node& node,
                     Node* nodes, uint32_t& nodeCount, uint32_t* primitives, uint32_t begin) {
    return HWY_DYNAMIC_DISPATCH(build)(references, count, rule, node, nodes, nodeCount, primitives, begin);
}

}  // namespace bvhio
#endif
