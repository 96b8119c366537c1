// Where the sibling pairs of a tree go when it is stored in clusters. Each pair is a record of fixed size in
// a slot, and pointers inside a cluster are short (G. Liktor, K. Vaidyanathan, "Bandwidth-Efficient BVH
// Layout for Incremental Hardware Traversal", HPG 2016).
#pragma once

#include <cstdint>
#include <string>

#include "core/shared_array.h"

namespace bvhio {

struct Bvh;

/// What each slot holds. Pair p is nodes 2 p + 2 and 2 p + 3. An address cluster is a run of slots from the
/// start of a line up to the next cluster. Pointers stay inside a cluster, with one exception: a glue record.
/// It stands in the cluster of a pair's parent, and its full pointer leads to the first slot of the cluster
/// that starts with the pair's record.
struct SlotMap {
    static constexpr uint32_t kEmpty = 0xFFFFFFFF;
    static constexpr uint32_t kGlue = 1u << 31;
    static constexpr uint32_t kMinPointerBits = 2, kMaxPointerBits = 10;
    /// One 11-bit number space addresses both the slots and the leaf entries of a cluster: maxEntries is what
    /// the slots leave for entries.
    static constexpr uint32_t kReferenceBits = 11;
    static constexpr uint32_t maxEntries(uint32_t pointerBits) {
        return (1u << kReferenceBits) - (1u << pointerBits);
    }
    static constexpr uint32_t kMaxLeafSize = 32;
    static constexpr uint32_t kMaxLineSlots = 64;

    uint32_t pointerBits = 0;  // a cluster has at most 2^pointerBits slots
    uint32_t lineSlots = 1;    // slots in a line, a power of two
    /// For each slot: a pair's index (its record), a pair's index | kGlue (a glue record that leads to it),
    /// or kEmpty. No words at all: the tree is not in clusters.
    SharedArray<uint32_t> words;

    bool empty() const { return words.empty(); }
};

/// Checks that the tree's map matches the tree: each pair has one record, after the record of its parent, and
/// clusters and glue are as SlotMap says. Returns "" if so, and else the fault in one line. O(n).
std::string validateSlots(const Bvh& bvh);

/// What the slots of a map are used for.
struct SlotStats {
    uint64_t slots = 0, records = 0, glue = 0, empty = 0, clusters = 0;

    double glueShare() const { return records == 0 ? 0 : double(glue) / double(records); }
    double paddingShare() const { return slots == 0 ? 0 : double(empty) / double(slots); }
    /// Returns the used share of the slots that pointers could reach.
    double fill(uint32_t pointerBits) const {
        return clusters == 0 ? 0 : double(records + glue) / (double(clusters) * double(1u << pointerBits));
    }
};
SlotStats statsOf(const SlotMap& map);

}  // namespace bvhio
