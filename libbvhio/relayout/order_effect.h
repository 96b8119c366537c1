// What a layout did to a tree, by the model that layouts are driven by: weights of pairs.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// Before and after: how many steps from a pair to one below its nodes lead into another block of memory, for
/// each ray that fetches the topmost pair, where pairs are fetched as often as their weights say. One by
/// way of glue counts where it changes blocks: towards the glue, and from there. What is popped from a stack
/// comes from elsewhere, and caches keep what was fetched before: misses are fewer, or more.
struct ExpectedChanges {
    double before = 0, after = 0;
};

struct OrderEffect {
    static constexpr uint32_t kPageBytes = 4096;

    uint64_t pairs = 0;
    uint64_t moved = 0;             // pairs that have another number in memory
    uint32_t recordBytes = 0;       // of a pair: what the rest is counted with
    uint64_t lines = 0, pages = 0;  // that the records take after it
    ExpectedChanges lineChanges, pageChanges;
};

/// For records as the options say, one after another from the first on, but in their slots where the layout
/// made clusters, of 8 bytes. A record is where it begins. By the options' weights, or by areas. O(n).
OrderEffect effectOf(const Bvh& before, const LayoutResult& layout, const LayoutOptions& options);

}  // namespace bvhio
