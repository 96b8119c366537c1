// The quantized form: one record for both children of an inner node, 16 bytes.
//
// M. Ernst, S. Woop, "Ray Tracing with Shared-Plane Bounding Volume Hierarchies", 2011: of the twelve planes
// of two siblings, six are their parent's. So a record stores one plane for each side and a bit that says
// which child has it; the other child inherits. K. Vaidyanathan, T. Akenine-Moeller, M. Salvi, "Watertight
// Ray Traversal with Reduced Precision", HPG 2016: planes are small integers relative to the parent's box,
// and a ray carries the parameters of the planes instead of a box.
//
// Departures: planes are insets from the parent's side, so 0 means inherited and no sign is stored. One
// margin per ray covers rounding (trace/ray_frame.h has the proof), instead of one at each step.
#pragma once

#include <array>

#include "compress/forest.h"
#include "compress/form_concept.h"
#include "compress/root_places.h"

namespace bvhio {

/// The two children of an inner node in 16 bytes. Plain data, stored unchanged in files
/// (format-spec/quantized.md).
struct alignas(16) QuantizedRecord {
    static constexpr uint32_t kMaxLeafSize = 128;
    static constexpr uint32_t kMaxReferences = 1u << 29;
    static constexpr uint32_t kMinBits = 5, kMaxBits = 8;

    /// Bytes 0 to 2 and 4 to 6: the insets of the planes min x, y, z and max x, y, z from the parent's. Bytes
    /// 3 and 7: bits 0 to 2 are the owners of these planes, 1 for the right child; bits 3 to 7 are the high
    /// bits of a leaf's size, the left child's in byte 3.
    uint8_t bytes[8];
    uint32_t children[2];

    constexpr uint32_t inset(uint32_t side) const { return bytes[side + side / 3]; }
    constexpr bool ownerIsRight(uint32_t side) const { return bytes[side < 3 ? 3 : 7] >> side % 3 & 1; }
    /// Returns a child's 8 bits above its word: with them a cursor holds the child in 40 bits.
    constexpr uint8_t highBits(uint32_t child) const { return bytes[3 + 4 * child]; }

    static constexpr bool isLeaf(uint32_t word) { return word >> 31 != 0; }
    /// Returns the record of an inner node.
    static constexpr uint32_t record(uint32_t word) { return word; }
    static constexpr uint32_t firstPrimitive(uint32_t word) { return word & (kMaxReferences - 1); }
    static constexpr uint32_t primitiveCount(uint32_t word, uint8_t highBits) {
        return (uint32_t(highBits >> 3) << 2 | (word >> 29 & 3)) + 1;
    }

    void setPlane(uint32_t side, uint32_t inset, bool ownerIsRight) {
        bytes[side + side / 3] = uint8_t(inset);
        bytes[side < 3 ? 3 : 7] |= uint8_t(ownerIsRight << side % 3);
    }
    void setInner(uint32_t child, uint32_t record) { children[child] = record; }
    void setLeaf(uint32_t child, uint32_t first, uint32_t count) {
        children[child] = 1u << 31 | (count - 1) % 4 << 29 | first;
        bytes[3 + 4 * child] |= uint8_t((count - 1) / 4 << 3);
    }
};
static_assert(sizeof(QuantizedRecord) == 16);

/// The root of one of many trees: its word and `highBits`, as a record holds a child.
struct QuantizedRoot {
    uint32_t word, highBits;
};
static_assert(sizeof(QuantizedRoot) == 8);

class QuantizedForm {
  public:
    static constexpr std::string_view kName = "quantized";
    static constexpr std::string_view kSummary = "16 bytes for two siblings, planes relative to the parent's";
    static constexpr FormTraits kTraits{.keepsOrder = true, .dividesLeaves = true};
    static constexpr std::array<std::string_view, 1> kCandidates{""};

    struct Options {
        uint32_t bits = 8;  // per plane, 5 to 8
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable();

    /// `records` as in format-spec/quantized.md. `bits` of an inset; a tree without records is one leaf of
    /// all references.
    QuantizedForm(const Aabb& bounds, uint32_t bits, SharedArray<QuantizedRecord> records,
                  SharedArray<uint32_t> primitives)
        : bounds_(bounds), bits_(bits), records_(std::move(records)), primitives_(std::move(primitives)) {}

    /// O(n). Leaves of more than 128 triangles are halved. Throws Error{unsupported} above 2^29 references.
    static QuantizedForm encode(const Scene& scene, const Bvh& bvh, const Options& options);

    Bvh decode() const { return decode(nullptr); }
    /// Decodes the nodes, and their boxes as insets to `insets`, with room for 2 * records + 2 elements.
    Bvh decode(InsetBox* insets) const;

    /// Trees whose records share one array.
    struct Trees {
        SharedArray<QuantizedRoot> roots;
        SharedArray<QuantizedRecord> records;
    };
    /// Encode and decode the trees of a forest, whose roots have the boxes of `places`.
    static Trees encodeTrees(const Forest& forest, const RootPlaces& places, size_t references,
                             uint32_t bits);
    static Forest decodeTrees(const Trees& trees, const RootPlaces& places, uint32_t bits);

    const Aabb& bounds() const { return bounds_; }
    uint32_t bits() const { return bits_; }
    const SharedArray<QuantizedRecord>& records() const { return records_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    Options options() const { return {.bits = bits_}; }
    size_t nodeBytes() const { return records_.size() * sizeof(QuantizedRecord); }

    QuantizedRoot root() const {
        if (!records_.empty()) return {0, 0};
        QuantizedRecord record{};
        record.setLeaf(0, 0, uint32_t(primitives_.size()));
        return {record.children[0], record.highBits(0)};
    }

  private:
    Aabb bounds_;
    uint32_t bits_;
    SharedArray<QuantizedRecord> records_;
    SharedArray<uint32_t> primitives_;
};
static_assert(Form<QuantizedForm>);

}  // namespace bvhio
