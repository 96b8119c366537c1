// The quantized form with short pointers: one record for both children of an inner node, 8 bytes.
//
// Planes are those of the quantized form (compress/quantized_form.h) with 6 bits. Pointers reach the slots
// and leaves of an address cluster alone; glue records lead from one to the next (G. Liktor, K. Vaidyanathan,
// "Bandwidth-Efficient BVH Layout for Incremental Hardware Traversal", HPG 2016).
//
// Departures: a reference is one number for slots and leaves alike, so none of its bits tells them apart; a
// cluster has a run of the leaf order of its own, whose start glue records hold as well; glue has no box.
#pragma once

#include <array>
#include <bit>
#include <cstring>

#include "compress/form_concept.h"
#include "compress/inset_box.h"

namespace bvhio {

/// What a slot holds; 8 bytes, plain data, stored as is in files (format-spec/quantized-short.md).
class ShortRecord {
  public:
    static constexpr uint32_t kBits = 6;
    static constexpr uint32_t kMaxLeafSize = SlotMap::kMaxLeafSize;
    static constexpr uint32_t kEntryBits = 27, kMaxReferences = 1u << kEntryBits;
    static constexpr uint32_t kLineBits = 26;

    /// To a cluster that starts with the line and has its entries from `firstEntry` on.
    static constexpr ShortRecord glue(uint32_t line, uint32_t firstEntry) {
        ShortRecord record;
        record.words_ = {line & (kInLow - 1), firstEntry | (line >> kLowBits) << kEntryBits};
        return record;
    }

    /// No record of two siblings has 0 for its left child: that is its cluster's first slot.
    constexpr bool isGlue() const { return words_[0] < kInLow; }
    constexpr bool isEmpty() const { return words_[0] == 0 && words_[1] == 0; }
    constexpr uint32_t line() const { return words_[0] | (words_[1] >> kEntryBits) << kLowBits; }
    constexpr uint32_t firstEntry() const { return words_[1] & (kMaxReferences - 1); }

    /// Of a child, 0 or 1: below 2^pointerBits a slot of the cluster, else a leaf's first entry of it.
    constexpr uint32_t reference(uint32_t child) const { return words_[child] >> kLowBits; }
    constexpr uint32_t inset(uint32_t side) const {
        return words_[side / 3] >> kBits * (side % 3) & ((1u << kBits) - 1);
    }
    constexpr bool isRights(uint32_t side) const { return words_[side / 3] >> (kOwnerBit + side % 3) & 1; }

    constexpr void setReference(uint32_t child, uint32_t value) { words_[child] |= value << kLowBits; }
    constexpr void setPlane(uint32_t side, uint32_t inset, bool isRights) {
        words_[side / 3] |= inset << kBits * (side % 3) | uint32_t(isRights) << (kOwnerBit + side % 3);
    }

    const uint32_t* words() const { return words_.data(); }

    static constexpr uint32_t kOwnerBit = 3 * kBits;

  private:
    static constexpr uint32_t kLowBits = 32 - SlotMap::kReferenceBits, kInLow = 1u << kLowBits;

    /// Of min and of max each: in bits 0 to 17 three insets, in 18 to 20 whose planes those are, a 1 for the
    /// right child; in 21 to 31 the left child's reference, the right one's.
    std::array<uint32_t, 2> words_{};
};
static_assert(sizeof(ShortRecord) == 8);

class QuantizedShortForm {
  public:
    static constexpr std::string_view kName = "quantized-short";
    static constexpr std::string_view kSummary = "8 bytes for two siblings, with short pointers in clusters";

    /// Slots and bitmap as in format-spec/quantized-short.md; no bitmap where each leaf owns one entry.
    QuantizedShortForm(const Aabb& bounds, uint32_t pointerBits, uint32_t lineSlots,
                       SharedArray<ShortRecord> slots, SharedArray<uint32_t> lastEntries,
                       SharedArray<uint32_t> primitives)
        : bounds_(bounds),
          pointerBits_(pointerBits),
          firstLeaf_(1u << pointerBits),
          lineShift_(uint32_t(std::countr_zero(lineSlots))),
          slots_(std::move(slots)),
          lastEntries_(std::move(lastEntries)),
          primitives_(std::move(primitives)) {}

    /// O(n log n), or O(n) where the tree is in clusters already that suit the form. Leaves of more than 32
    /// triangles are halved. Throws Error{unsupported} above 2^27 references.
    static QuantizedShortForm encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options);

    /// In clusters, its pairs in the order of their slots.
    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    uint32_t pointerBits() const { return pointerBits_; }
    uint32_t lineSlots() const { return 1u << lineShift_; }
    const SharedArray<ShortRecord>& slots() const { return slots_; }
    const SharedArray<uint32_t>& lastEntries() const { return lastEntries_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    EncodeOptions options() const {
        EncodeOptions options;
        options.pointerBits = pointerBits_;
        options.lineSize = uint32_t(sizeof(ShortRecord)) << lineShift_;
        return options;
    }
    size_t nodeBytes() const {
        return slots_.size() * sizeof(ShortRecord) + lastEntries_.size() * sizeof(uint32_t);
    }

    /// The least reference of a leaf.
    uint32_t firstLeaf() const { return firstLeaf_; }
    /// The first slot of a cluster that starts with the line.
    uint32_t firstSlotOf(uint32_t line) const { return line << lineShift_; }
    /// Of the bitmap: a bit for each entry of the leaf order, and a word more, so that two can be read.
    static constexpr size_t lastEntryWords(size_t references) { return (references + 31) / 32 + 1; }
    /// Of a leaf by its reference, in a cluster whose entries begin with `clustersFirst`.
    uint32_t firstEntryOf(uint32_t clustersFirst, uint32_t reference) const {
        return clustersFirst + (reference - firstLeaf_);
    }
    /// The entries of the leaf that begins with `entry`, which must be one: more than kMaxLeafSize where its
    /// last one is not marked soon enough.
    uint32_t countFrom(uint32_t entry) const {
        if (lastEntries_.empty()) return 1;
        const uint32_t* words = lastEntries_.data() + entry / 32;
        const uint64_t marks = (uint64_t(words[1]) << 32 | words[0]) >> entry % 32;
        return uint32_t(std::countr_zero(marks)) + 1;
    }

  private:
    Aabb bounds_;
    uint32_t pointerBits_;
    uint32_t firstLeaf_;  // the least reference of a leaf
    uint32_t lineShift_;
    SharedArray<ShortRecord> slots_;
    SharedArray<uint32_t> lastEntries_;
    SharedArray<uint32_t> primitives_;
};
static_assert(Form<QuantizedShortForm>);

}  // namespace bvhio
