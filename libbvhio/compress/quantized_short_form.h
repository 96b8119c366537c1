// The quantized form with short pointers: one record for both children of an inner node, 8 bytes.
//
// Planes are those of the quantized form (compress/quantized_form.h) with 6 bits. Pointers reach only the
// slots and leaves of their address cluster. Glue records lead from one cluster to the next (G. Liktor, K.
// Vaidyanathan, "Bandwidth-Efficient BVH Layout for Incremental Hardware Traversal", HPG 2016).
//
// Departures: one number space holds both slots and leaves, so no bit of a reference distinguishes them. Each
// cluster has its own run of the leaf order, and its glue record holds the start of the run. Glue has no box.
#pragma once

#include <array>
#include <bit>
#include <cstring>

#include "compress/form_concept.h"
#include "compress/inset_box.h"

namespace bvhio {

/// The content of a slot in 8 bytes. Plain data, stored unchanged in files (format-spec/quantized-short.md).
class ShortRecord {
  public:
    static constexpr uint32_t kBits = 6;
    static constexpr uint32_t kMaxLeafSize = SlotMap::kMaxLeafSize;
    static constexpr uint32_t kEntryBits = 27, kMaxReferences = 1u << kEntryBits;
    static constexpr uint32_t kLineBits = 26;

    /// Makes glue to a cluster that starts with the line and has its leaf entries from `firstEntry` on.
    static constexpr ShortRecord glue(uint32_t line, uint32_t firstEntry) {
        ShortRecord record;
        record.words_ = {line & (kInLow - 1), firstEntry | (line >> kLowBits) << kEntryBits};
        return record;
    }

    /// Returns whether this is glue, or empty: no other record has the left reference 0, its cluster's start.
    constexpr bool isGlue() const { return words_[0] < kInLow; }
    constexpr bool isEmpty() const { return words_[0] == 0 && words_[1] == 0; }
    constexpr uint32_t line() const { return words_[0] | (words_[1] >> kEntryBits) << kLowBits; }
    constexpr uint32_t firstEntry() const { return words_[1] & (kMaxReferences - 1); }

    /// Returns the reference of child 0 or 1: below 2^pointerBits a slot of the cluster, else its leaf entry.
    constexpr uint32_t reference(uint32_t child) const { return words_[child] >> kLowBits; }
    constexpr uint32_t inset(uint32_t side) const {
        return words_[side / 3] >> kBits * (side % 3) & ((1u << kBits) - 1);
    }
    constexpr bool ownerIsRight(uint32_t side) const {
        return words_[side / 3] >> (kOwnerBit + side % 3) & 1;
    }

    constexpr void setReference(uint32_t child, uint32_t value) { words_[child] |= value << kLowBits; }
    constexpr void setPlane(uint32_t side, uint32_t inset, bool ownerIsRight) {
        words_[side / 3] |= inset << kBits * (side % 3) | uint32_t(ownerIsRight) << (kOwnerBit + side % 3);
    }

    const uint32_t* words() const { return words_.data(); }

    static constexpr uint32_t kOwnerBit = 3 * kBits;

  private:
    static constexpr uint32_t kLowBits = 32 - SlotMap::kReferenceBits, kInLow = 1u << kLowBits;

    /// One word each for the min and the max sides. Bits 0 to 17: three insets. Bits 18 to 20: the owners of
    /// these planes, 1 for the right child. Bits 21 to 31: the left, in the other word the right reference.
    std::array<uint32_t, 2> words_{};
};
static_assert(sizeof(ShortRecord) == 8);

class QuantizedShortForm {
  public:
    static constexpr std::string_view kName = "quantized-short";
    static constexpr std::string_view kSummary = "8 bytes for two siblings, with short pointers in clusters";
    static constexpr FormTraits kTraits{.dividesLeaves = true, .putsInClusters = true};
    static constexpr std::array<std::string_view, 1> kCandidates{""};

    /// Of new clusters.
    struct Options {
        uint32_t pointerBits = 8;  // 2 to 10
        uint32_t lineSize = 64;    // bytes: a power of two, 8 to 512
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable();

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
    static QuantizedShortForm encode(const Scene& scene, const Bvh& bvh, const Options& options);

    /// Decodes to a tree in clusters, with its pairs in the order of their slots.
    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    uint32_t pointerBits() const { return pointerBits_; }
    uint32_t lineSlots() const { return 1u << lineShift_; }
    const SharedArray<ShortRecord>& slots() const { return slots_; }
    const SharedArray<uint32_t>& lastEntries() const { return lastEntries_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    Options options() const {
        return {.pointerBits = pointerBits_, .lineSize = uint32_t(sizeof(ShortRecord)) << lineShift_};
    }
    size_t nodeBytes() const {
        return slots_.size() * sizeof(ShortRecord) + lastEntries_.size() * sizeof(uint32_t);
    }

    /// Returns the least reference of a leaf.
    uint32_t firstLeaf() const { return firstLeaf_; }
    /// Returns the first slot of the cluster that starts with the line.
    uint32_t firstSlotOf(uint32_t line) const { return line << lineShift_; }
    /// Returns the size of the bitmap: one bit per leaf entry, and one more word, so that two can be read.
    static constexpr size_t lastEntryWords(size_t references) { return (references + 31) / 32 + 1; }
    /// Returns the first entry of a leaf, in a cluster whose entries start at `clustersFirst`.
    uint32_t firstEntryOf(uint32_t clustersFirst, uint32_t reference) const {
        return clustersFirst + (reference - firstLeaf_);
    }
    /// Returns the size of the leaf that starts at `entry`. The entry must exist. The result exceeds
    /// kMaxLeafSize if the leaf's last entry is not marked in time.
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
