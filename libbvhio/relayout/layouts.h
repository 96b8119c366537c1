// The table of layouts, which order a tree's nodes in memory. Layouts change neither the tree nor its cost.
#pragma once

#include "core/choice.h"
#include "relayout/node_order.h"
#include "relayout/pair_weights.h"

namespace bvhio {

/// The options that only some layouts use.
enum LayoutUses : uint32_t {
    kUsesWeights = 1,
    kUsesLines = 2,  // lineSize and recordBytes
    kUsesThreshold = 4,
    kUsesTreeletSize = 8,
    kUsesPointerBits = 16,
    kUsesLineSize = 32,  // without recordBytes
};

struct LayoutOptions {
    uint32_t lineSize = 64;     // bytes of a cache line
    uint32_t recordBytes = 16;  // bytes of a pair's record in the form that the order is for (quantized: 16)
    float threshold = -1;  // treelets contain children above this probability; below 0: the layout's default
    uint32_t treeletSize = 0;  // the most pairs of a treelet; 0: the layout's default
    uint32_t pointerBits = 8;  // of a reference within an address cluster
    /// How often each pair is fetched, by half the index of its left node, in any unit. Empty: areas count.
    PairWeights weights{};

    uint32_t recordsPerLine() const { return lineSize > recordBytes ? lineSize / recordBytes : 1; }
};

struct LayoutResult {
    NodeOrder order;
    /// The clusters of the tree in that order, if the layout makes clusters.
    SlotMap slots{};
};

/// A layout's order depends only on the tree, the weights and the options, and not on the previous order of
/// nodes. So applying a layout twice is the same as applying it once.
using Layout = Choice<Method<LayoutResult(const Bvh&, const LayoutOptions&)>>;

/// Returns all layouts, the default first.
std::span<const Layout> layouts();

}  // namespace bvhio
