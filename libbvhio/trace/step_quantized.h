// Steps rays through the quantized form. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_QUANTIZED_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_QUANTIZED_H
#undef BVHIO_TRACE_STEP_QUANTIZED_H
#else
#define BVHIO_TRACE_STEP_QUANTIZED_H
#endif

#include "compress/quantized_form.h"
#include "trace/ray_frame.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

template <>
class Stepper<QuantizedForm> {
  public:
    using Ray = RayFrame;
    static constexpr int kMaxPushed = 1;

    struct Cursor {
        PlacedBox box;
        uint32_t word;
        uint8_t highBits;
    };

    explicit Stepper(const QuantizedForm& form)
        : form_(form), records_(form.records().data()), stepOfSize_(1 / float(1u << form.bits())) {}

    RayFrame prepare(const PreparedRay& ray) const { return {ray, form_.bounds()}; }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const RayFrame& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval part = ray.clip(ray.root(), tLimit);
        const QuantizedRoot stored = form_.root();
        root = {{ray.root(), stored.word, uint8_t(stored.highBits)}, part.enter};
        return !part.isEmpty();
    }

    /// The arithmetic per pair: 3 differences for the size of the box, 6 products and 6 sums for the new
    /// planes, and 3 sums per child for the margin.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                         Entered<Cursor>& next, Entered<Cursor>*& top, Metrics& metrics) const {
        const uint32_t index = QuantizedRecord::record(from.cursor.word);
        metrics.recordFetched(index * sizeof(QuantizedRecord), sizeof(QuantizedRecord));
        metrics.boxesTested(1, BoxTestCost{11, 12});
        metrics.boxesTested(1, BoxTestCost{10, 12});
        const QuantizedRecord& record = records_[index];
        PlacedBox left, right;
        placeChildren(record, from.cursor.box, left, right);
        const EnteredOfTwo found = ray.clip(left, right, tLimit);
        const auto enter = [&](uint32_t child, Entered<Cursor>& entered) HWY_ATTR {
            entered = {{child == 0 ? left : right, record.children[child], record.highBits(child)},
                       found.enter[child]};
        };
        return enterInOrder(found, enter, next, top, metrics);
    }

    HWY_INLINE bool isLeaf(const Cursor& cursor) const { return QuantizedRecord::isLeaf(cursor.word); }
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor) const {
        return {QuantizedRecord::firstPrimitive(cursor.word),
                QuantizedRecord::primitiveCount(cursor.word, cursor.highBits)};
    }

  private:
    /// Places the boxes of the children.
    HWY_INLINE void placeChildren(const QuantizedRecord& record, const PlacedBox& box, PlacedBox& left,
                                  PlacedBox& right) const {
        Four mins, maxs;
        FourInts minHead, maxHead;  // bytes 0 to 3 and 4 to 7, in all lanes
#if defined(__SSE2__)
        const __m128i zero = _mm_setzero_si128();
        const __m128i raw = _mm_load_si128(reinterpret_cast<const __m128i*>(&record));
        const __m128i words = _mm_unpacklo_epi8(raw, zero);
        // Lane 3 gets any number, which is multiplied by a size of 0.
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

    const QuantizedForm& form_;
    const QuantizedRecord* records_;
    float stepOfSize_;  // 2^-bits
};
static_assert(SteppableTree<Stepper<QuantizedForm>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
