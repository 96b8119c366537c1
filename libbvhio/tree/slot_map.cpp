#include "tree/slot_map.h"

#include <bit>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {
namespace {

constexpr uint32_t kNoPlace = 0xFFFFFFFF;

std::string atSlot(size_t slot, const std::string& what) {
    return "slot " + std::to_string(slot) + what;
}

/// The pair of each pair's parent; kNoPlace for the root's children.
std::vector<uint32_t> parentsOfPairs(const Bvh& bvh) {
    std::vector<uint32_t> parents(bvh.nodes.size() / 2 - 1, kNoPlace);
    for (size_t i = 2; i < bvh.nodes.size(); ++i)
        if (!bvh.nodes[i].isLeaf()) parents[bvh.nodes[i].left() / 2 - 1] = uint32_t(i / 2 - 1);
    return parents;
}

}  // namespace

std::string faultOfSlots(const Bvh& bvh) {
    const SlotMap& map = bvh.slots;
    if (map.pointerBits < SlotMap::kMinPointerBits || map.pointerBits > SlotMap::kMaxPointerBits)
        return "pointers of " + std::to_string(map.pointerBits) + " bits: 2 to 10 are known";
    if (!std::has_single_bit(map.lineSlots) || map.lineSlots > SlotMap::kMaxLineSlots)
        return "lines of " + std::to_string(map.lineSlots) + " slots: no power of two up to 64";
    const std::vector<uint32_t> parents = parentsOfPairs(bvh);
    const size_t pairs = parents.size();
    std::vector<uint32_t> slotOf(pairs, kNoPlace), glueOf(pairs, kNoPlace);
    size_t records = 0;
    for (size_t slot = 0; slot < map.words.size(); ++slot) {
        const uint32_t word = map.words[slot], pair = word & ~SlotMap::kGlue;
        if (word == SlotMap::kEmpty) continue;
        if (pair >= pairs) return atSlot(slot, " names pair " + std::to_string(pair) + ", which is none");
        std::vector<uint32_t>& of = (word & SlotMap::kGlue) != 0 ? glueOf : slotOf;
        if (of[pair] != kNoPlace) return atSlot(slot, " repeats " + atSlot(of[pair], ""));
        of[pair] = uint32_t(slot);
        records += (word & SlotMap::kGlue) == 0;
    }
    if (records != pairs) return std::to_string(pairs - records) + " pairs have no slot";
    // The first slot of each slot's cluster: a cluster starts where the record lies that a glue record names.
    std::vector<uint32_t> clusterOf(map.words.size());
    uint32_t cluster = 0;
    for (size_t slot = 0; slot < map.words.size(); ++slot) {
        const uint32_t word = map.words[slot];
        if ((word & SlotMap::kGlue) == 0 && (glueOf[word] != kNoPlace || parents[word] == kNoPlace)) {
            cluster = uint32_t(slot);
            if (slot % map.lineSlots != 0) return atSlot(slot, " starts a cluster but no line");
        }
        if (word != SlotMap::kEmpty && (slot - cluster) >> map.pointerBits != 0)
            return atSlot(slot, " is out of reach from the cluster's first");
        clusterOf[slot] = cluster;
    }
    for (size_t pair = 0; pair < pairs; ++pair) {
        const uint32_t parent = parents[pair];
        if (parent == kNoPlace) {
            if (slotOf[pair] != 0) return "slot 0 does not hold the root's children";
            if (glueOf[pair] != kNoPlace) return atSlot(glueOf[pair], " leads to the root's children");
            continue;
        }
        const uint32_t named = glueOf[pair] != kNoPlace ? glueOf[pair] : slotOf[pair];
        if (clusterOf[named] != clusterOf[slotOf[parent]])
            return atSlot(named, " is in another cluster than the parent's");
        if (named <= slotOf[parent] || slotOf[pair] < named)
            return atSlot(named, " is not behind the parent's");
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
