// Measures the effect of a layout on a tree by the model that layouts use: weights of pairs.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// The expected number of steps from a pair to a pair below it that lead into another block of memory, for
/// each ray that fetches the topmost pair, if pairs are fetched as often as their weights say. A step by way
/// of glue counts up to twice: towards the glue, and from there. The number of cache misses differs: nodes
/// that are popped from a stack are elsewhere in memory, and caches keep what was fetched before.
struct ExpectedChanges {
    double before = 0, after = 0;
};

struct OrderEffect {
    static constexpr uint32_t kPageBytes = 4096;

    uint64_t pairs = 0;
    uint64_t moved = 0;             // pairs whose place in memory changed
    uint32_t recordBytes = 0;       // the size of a pair's record, used for the following numbers
    uint64_t lines = 0, pages = 0;  // of the records after the layout
    ExpectedChanges lineChanges, pageChanges;
};

/// Computes the effect of a layout, by the options' weights or else by areas. Records have the options' size
/// and follow one another; if the layout made clusters, they have 8 bytes and are in their slots. A record
/// counts for the block in which it begins. O(n).
OrderEffect effectOf(const Bvh& before, const LayoutResult& layout, const LayoutOptions& options);

}  // namespace bvhio
