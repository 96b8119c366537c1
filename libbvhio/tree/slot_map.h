// Where the sibling pairs of a tree lie when it is stored in clusters: records of one size, one for each
// pair, in slots, with short pointers inside a cluster (G. Liktor, K. Vaidyanathan, "Bandwidth-Efficient BVH
// Layout for Incremental Hardware Traversal", HPG 2016).
#pragma once

#include <cstdint>
#include <string>

#include "core/shared_array.h"

namespace bvhio {

struct Bvh;

/// What each slot holds. Pair p is nodes 2 p + 2 and 2 p + 3. An address cluster is a run of slots from a
/// line's start up to the next cluster, whose first record is the only one that is named from elsewhere: by
/// one glue record, in the slots of the cluster that has the pair's parent. It names the first of its
/// cluster's slots, by a full pointer; all other pointers stay inside a cluster.
struct SlotMap {
    static constexpr uint32_t kEmpty = 0xFFFFFFFF;
    static constexpr uint32_t kGlue = 1u << 31;
    static constexpr uint32_t kMinPointerBits = 2, kMaxPointerBits = 10;
    /// References of so many bits name slots of a cluster and entries of the leaf order that its leaves own,
    /// at most so many, alike.
    static constexpr uint32_t kReferenceBits = 11;
    static constexpr uint32_t maxEntries(uint32_t pointerBits) {
        return (1u << kReferenceBits) - (1u << pointerBits);
    }
    static constexpr uint32_t kMaxLeafSize = 32;
    static constexpr uint32_t kMaxLineSlots = 64;

    uint32_t pointerBits = 0;  // a cluster has at most 2^pointerBits slots,
    uint32_t lineSlots = 1;    // a power of two: how many fill a line
    /// A pair's index: its record; the same with kGlue: a glue record for it; or kEmpty. Empty: the tree is
    /// not in clusters.
    SharedArray<uint32_t> words;

    bool empty() const { return words.empty(); }
};

/// Why the map is none of this tree's, in one line; "" where it is one: each pair has one record, which lies
/// behind its parent's, and clusters and glue are as SlotMap says. O(n).
std::string faultOfSlots(const Bvh& bvh);

/// How a map spends its slots.
struct SlotStats {
    uint64_t slots = 0, records = 0, glue = 0, empty = 0, clusters = 0;

    double glueShare() const { return records == 0 ? 0 : double(glue) / double(records); }
    double paddingShare() const { return slots == 0 ? 0 : double(empty) / double(slots); }
    /// Of the slots that pointers could reach.
    double fill(uint32_t pointerBits) const {
        return clusters == 0 ? 0 : double(records + glue) / (double(clusters) * double(1u << pointerBits));
    }
};
SlotStats statsOf(const SlotMap& map);

}  // namespace bvhio
