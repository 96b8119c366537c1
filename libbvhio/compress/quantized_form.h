// The quantized form: one record for both children of an inner node, 16 bytes.
//
// M. Ernst, S. Woop, "Ray Tracing with Shared-Plane Bounding Volume Hierarchies", 2011: of the twelve planes
// of two siblings six are their parent's, so a record stores one plane for each side, and a mask says which
// child has it; the other inherits. K. Vaidyanathan, T. Akenine-Moeller, M. Salvi, "Watertight Ray Traversal
// with Reduced Precision", HPG 2016: planes are small integers relative to the parent's box, and a ray
// carries the parameters of the planes instead of a box.
//
// Departures: planes are insets from the parent's side, so 0 means inherited and no sign is stored; rounding
// is paid for by one margin a ray (compress/ray_frame.h has the proof), not at each step.
#pragma once

#include "compress/ray_frame.h"
#include "compress/root_places.h"
#include "compress/two_levels.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace bvhio {

/// What an inner node says of its two children; 16 bytes, plain data, stored as is in files
/// (format-spec/quantized.md).
struct alignas(16) QuantizedRecord {
    static constexpr uint32_t kMaxLeafSize = 128;
    static constexpr uint32_t kMaxReferences = 1u << 29;
    static constexpr uint32_t kMinBits = 5, kMaxBits = 8;

    /// Bytes 0 to 2, 4 to 6: how far the planes min x, y, z and max x, y, z lie inside the parent's. Bytes 3
    /// and 7: in bits 0 to 2 whose those planes are, a 1 for the right child; in bits 3 to 7 the higher part
    /// of a leaf's size, in byte 3 for the left child.
    uint8_t bytes[8];
    uint32_t children[2];

    constexpr uint32_t inset(uint32_t side) const { return bytes[side + side / 3]; }
    constexpr bool isRights(uint32_t side) const { return bytes[side < 3 ? 3 : 7] >> side % 3 & 1; }
    /// A child in 40 bits, as a cursor holds it.
    constexpr uint8_t more(uint32_t child) const { return bytes[3 + 4 * child]; }

    static constexpr bool isLeaf(uint32_t word) { return word >> 31 != 0; }
    /// Of an inner node: its record.
    static constexpr uint32_t record(uint32_t word) { return word; }
    static constexpr uint32_t firstPrimitive(uint32_t word) { return word & (kMaxReferences - 1); }
    static constexpr uint32_t primitiveCount(uint32_t word, uint8_t more) {
        return (uint32_t(more >> 3) << 2 | (word >> 29 & 3)) + 1;
    }

    void setPlane(uint32_t side, uint32_t inset, bool isRights) {
        bytes[side + side / 3] = uint8_t(inset);
        bytes[side < 3 ? 3 : 7] |= uint8_t(isRights << side % 3);
    }
    void setInner(uint32_t child, uint32_t record) { children[child] = record; }
    void setLeaf(uint32_t child, uint32_t first, uint32_t count) {
        children[child] = 1u << 31 | (count - 1) % 4 << 29 | first;
        bytes[3 + 4 * child] |= uint8_t((count - 1) / 4 << 3);
    }
};
static_assert(sizeof(QuantizedRecord) == 16);

/// The root of one tree of many, as a record has a child: its word and `more`.
struct QuantizedRoot {
    uint32_t word, more;
};
static_assert(sizeof(QuantizedRoot) == 8);

class QuantizedForm {
  public:
    static constexpr std::string_view kName = "quantized";
    static constexpr std::string_view kSummary = "16 bytes for two siblings, planes relative to the parent's";
    static constexpr int kMaxChildren = 2;

    struct Cursor {
        PlacedBox box;
        uint32_t word;
        uint8_t more;
    };

    /// `records` as in format-spec/quantized.md. `bits` of an inset; a tree without records is one leaf of
    /// all references.
    QuantizedForm(const Aabb& bounds, uint32_t bits, SharedArray<QuantizedRecord> records,
                  SharedArray<uint32_t> primitives)
        : bounds_(bounds),
          bits_(bits),
          records_(std::move(records)),
          primitives_(std::move(primitives)),
          rootWord_(records_.empty() ? leaf().children[0] : 0),
          rootMore_(records_.empty() ? leaf().more(0) : uint8_t(0)),
          stepOfSize_(1 / float(1u << bits)) {}

    /// O(n). Leaves of more than 128 triangles are halved. Throws Error{unsupported} above 2^29 references.
    static QuantizedForm encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options);

    Bvh decode() const { return decode(nullptr); }
    /// The boxes as insets, too, by node: `insets` has room for two more than twice the records.
    Bvh decode(InsetBox* insets) const;

    /// Trees whose records share one array.
    struct Trees {
        SharedArray<QuantizedRoot> roots;
        SharedArray<QuantizedRecord> records;
    };
    /// The same for the trees of a forest, which have the boxes of `places` at their roots.
    static Trees encodeTrees(const Forest& forest, const RootPlaces& places, size_t references,
                             uint32_t bits);
    static Forest decodeTrees(const Trees& trees, const RootPlaces& places, uint32_t bits);

    const Aabb& bounds() const { return bounds_; }
    uint32_t bits() const { return bits_; }
    const SharedArray<QuantizedRecord>& records() const { return records_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    EncodeOptions options() const {
        EncodeOptions options;
        options.bits = bits_;
        return options;
    }
    size_t nodeBytes() const { return records_.size() * sizeof(QuantizedRecord); }

    using Ray = RayFrame;
    RayFrame prepare(const PreparedRay& ray) const { return {ray, bounds_}; }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const RayFrame& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        metrics.boxesTested(1, BoxTestCost{12, 12});
        const RayInterval part = ray.clip(ray.root(), tLimit);
        root = {{ray.root(), rootWord_, rootMore_}, part.enter};
        return !part.isEmpty();
    }

    /// Per pair: 3 differences for the size of the box, 6 products and 6 sums for the new planes, 3 sums a
    /// child for the margin.
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        const uint32_t index = QuantizedRecord::record(from.cursor.word);
        metrics.recordFetched(index * sizeof(QuantizedRecord), sizeof(QuantizedRecord));
        metrics.boxesTested(1, BoxTestCost{11, 12});
        metrics.boxesTested(1, BoxTestCost{10, 12});
        const QuantizedRecord& record = records_[index];
        PlacedBox left, right;
        placeChildren(record, from.cursor.box, left, right);
        const EnteredOfTwo found = ray.clip(left, right, tLimit);
        const auto enter = [&](uint32_t child, Entered<Cursor>& entered) {
            entered = {{child == 0 ? left : right, record.children[child], record.more(child)},
                       found.enter[child]};
        };
        return enterInOrder(found, enter, children);
    }

    bool isLeaf(const Cursor& cursor) const { return QuantizedRecord::isLeaf(cursor.word); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const {
        return {QuantizedRecord::firstPrimitive(cursor.word),
                QuantizedRecord::primitiveCount(cursor.word, cursor.more)};
    }

  private:
    QuantizedRecord leaf() const {
        QuantizedRecord record{};
        record.setLeaf(0, 0, uint32_t(primitives_.size()));
        return record;
    }

    /// The children's boxes as the ray sees them.
    BVHIO_INLINE void placeChildren(const QuantizedRecord& record, const PlacedBox& box, PlacedBox& left,
                                    PlacedBox& right) const {
        Four mins, maxs;
        FourInts minHead, maxHead;  // bytes 0 to 3 and 4 to 7, in all lanes
#if defined(__SSE2__)
        const __m128i zero = _mm_setzero_si128();
        const __m128i raw = _mm_load_si128(reinterpret_cast<const __m128i*>(&record));
        const __m128i words = _mm_unpacklo_epi8(raw, zero);
        // Lane 3 becomes some number, times a size of 0.
        mins = Four(_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero)));
        maxs = Four(_mm_cvtepi32_ps(_mm_unpackhi_epi16(words, zero)));
        minHead = FourInts(_mm_shuffle_epi32(raw, 0x00));
        maxHead = FourInts(_mm_shuffle_epi32(raw, 0x55));
#else
        const auto insets = [&](uint32_t side) {
            return Four{float(record.inset(side)), float(record.inset(side + 1)),
                        float(record.inset(side + 2)), 0};
        };
        mins = insets(0);
        maxs = insets(3);
        minHead = FourInts{} + int32_t(uint32_t(record.bytes[3]) << 24);
        maxHead = FourInts{} + int32_t(uint32_t(record.bytes[7]) << 24);
#endif
        const FourInts owners{1 << 24, 1 << 25, 1 << 26, 0};
        placeSiblings(box, mins * stepOfSize_, maxs * stepOfSize_, (minHead & owners) == owners,
                      (maxHead & owners) == owners, left, right);
    }

    Aabb bounds_;
    uint32_t bits_;
    SharedArray<QuantizedRecord> records_;
    SharedArray<uint32_t> primitives_;
    uint32_t rootWord_;
    uint8_t rootMore_;
    float stepOfSize_;  // 2^-bits
};
static_assert(Form<QuantizedForm>);

}  // namespace bvhio
