// The table of layouts: orders of a tree's nodes in memory. Layouts change neither the tree nor its cost.
#pragma once

#include "core/choice.h"
#include "relayout/node_order.h"
#include "relayout/pair_weights.h"

namespace bvhio {

/// The options that a layout may have a use for.
enum LayoutUses : uint32_t {
    kUsesWeights = 1,
    kUsesLines = 2,  // lineSize and recordBytes
    kUsesThreshold = 4,
    kUsesTreeletSize = 8,
    kUsesPointerBits = 16,
    kUsesLineSize = 32,  // without recordBytes
};

struct LayoutOptions {
    uint32_t lineSize = 64;  // bytes of a cache line
    uint32_t recordBytes =
        16;  // bytes of a pair's record in the form that the order is for: quantized has 16
    float threshold =
        -1;  // treelets go on to a child of at least this probability; below 0: the layout's own
    uint32_t treeletSize = 0;  // most pairs of a treelet; 0: the layout's own
    uint32_t pointerBits = 8;  // of a reference within an address cluster
    /// How often each pair is fetched, by half the index of its left node; any unit. None: by areas.
    PairWeights weights{};

    uint32_t recordsPerLine() const { return lineSize > recordBytes ? lineSize / recordBytes : 1; }
};

struct LayoutResult {
    NodeOrder order;
    /// How the tree in that order lies in clusters, where the layout makes some.
    SlotMap slots{};
};

/// A layout's order depends on the tree, its weights and the options alone: not on the order its nodes had
/// before, so applying a layout twice is applying it once.
using Layout = Choice<Method<LayoutResult(const Bvh&, const LayoutOptions&)>>;

/// All layouts, the default first.
std::span<const Layout> layouts();

}  // namespace bvhio
