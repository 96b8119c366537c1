#include "tree/slot_map.h"

#include <bit>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {
namespace {

constexpr uint32_t kNoPlace = 0xFFFFFFFF;

/// Returns a message about a slot.
std::string atSlot(size_t slot, const std::string& what) {
    return "slot " + std::to_string(slot) + what;
}

/// Returns for each pair the pair that holds its parent; kNoPlace for the root's children.
std::vector<uint32_t> parentsOfPairs(const Bvh& bvh) {
    std::vector<uint32_t> parents(bvh.nodes.size() / 2 - 1, kNoPlace);
    for (size_t i = 2; i < bvh.nodes.size(); ++i)
        if (!bvh.nodes[i].isLeaf()) parents[bvh.nodes[i].left() / 2 - 1] = uint32_t(i / 2 - 1);
    return parents;
}

}  // namespace

std::string validateSlots(const Bvh& bvh) {
    // The sizes.
    const SlotMap& map = bvh.slots;
    if (map.pointerBits < SlotMap::kMinPointerBits || map.pointerBits > SlotMap::kMaxPointerBits)
        return "pointers have " + std::to_string(map.pointerBits) + " bits, but must have 2 to 10";
    if (!std::has_single_bit(map.lineSlots) || map.lineSlots > SlotMap::kMaxLineSlots)
        return "lines have " + std::to_string(map.lineSlots) + " slots, which is not a power of two up to 64";

    // Each pair has one record, and at most one glue record.
    const std::vector<uint32_t> parents = parentsOfPairs(bvh);
    const size_t pairs = parents.size();
    std::vector<uint32_t> slotOf(pairs, kNoPlace), glueOf(pairs, kNoPlace);
    size_t records = 0;
    for (size_t slot = 0; slot < map.words.size(); ++slot) {
        const uint32_t word = map.words[slot], pair = word & ~SlotMap::kGlue;
        if (word == SlotMap::kEmpty) continue;
        if (pair >= pairs)
            return atSlot(slot, " refers to pair " + std::to_string(pair) + ", but there are only " +
                                    std::to_string(pairs));
        std::vector<uint32_t>& of = (word & SlotMap::kGlue) != 0 ? glueOf : slotOf;
        if (of[pair] != kNoPlace) return atSlot(slot, " holds the same as " + atSlot(of[pair], ""));
        of[pair] = uint32_t(slot);
        records += (word & SlotMap::kGlue) == 0;
    }
    if (records != pairs) return std::to_string(pairs - records) + " pairs have no slot";

    // The first slot of each slot's cluster. A cluster starts at a record that a glue record leads to.
    std::vector<uint32_t> clusterOf(map.words.size());
    uint32_t cluster = 0;
    for (size_t slot = 0; slot < map.words.size(); ++slot) {
        const uint32_t word = map.words[slot];
        if ((word & SlotMap::kGlue) == 0 && (glueOf[word] != kNoPlace || parents[word] == kNoPlace)) {
            cluster = uint32_t(slot);
            if (slot % map.lineSlots != 0) return atSlot(slot, " starts a cluster, but not a line");
        }
        if (word != SlotMap::kEmpty && (slot - cluster) >> map.pointerBits != 0)
            return atSlot(slot, " is too far from the first slot of its cluster for pointers");
        clusterOf[slot] = cluster;
    }

    // Each record, or the glue that leads to it, is in the cluster of the parent's record and after that
    // record.
    for (size_t pair = 0; pair < pairs; ++pair) {
        const uint32_t parent = parents[pair];
        if (parent == kNoPlace) {
            if (slotOf[pair] != 0) return "slot 0 does not hold the root's children";
            if (glueOf[pair] != kNoPlace)
                return atSlot(glueOf[pair], " is glue that leads to the root's children");
            continue;
        }
        const uint32_t named = glueOf[pair] != kNoPlace ? glueOf[pair] : slotOf[pair];
        if (clusterOf[named] != clusterOf[slotOf[parent]])
            return atSlot(named, " is not in the cluster of its parent's slot");
        if (named <= slotOf[parent] || slotOf[pair] < named)
            return atSlot(named, " is out of order: a parent's slot comes first, then glue, then the record");
    }
    return "";
}

SlotStats statsOf(const SlotMap& map) {
    SlotStats stats;
    stats.slots = map.words.size();
    for (const uint32_t word : map.words) {
        const bool isEmpty = word == SlotMap::kEmpty, isGlue = !isEmpty && (word & SlotMap::kGlue) != 0;
        stats.empty += isEmpty;
        stats.glue += isGlue;
        stats.records += !isEmpty && !isGlue;
    }
    stats.clusters = stats.records == 0 ? 0 : stats.glue + 1;
    return stats;
}

}  // namespace bvhio
