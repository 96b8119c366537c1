// Steps rays through the quantized-short form. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_QUANTIZED_SHORT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_QUANTIZED_SHORT_H
#undef BVHIO_TRACE_STEP_QUANTIZED_SHORT_H
#else
#define BVHIO_TRACE_STEP_QUANTIZED_SHORT_H
#endif

#include "compress/quantized_short_form.h"
#include "trace/ray_frame.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

template <>
class Stepper<QuantizedShortForm> {
  public:
    using Ray = RayFrame;
    static constexpr int kMaxPushed = 1;

    struct Cursor {
        PlacedBox box;
        uint32_t firstSlot, firstEntry;  // of the cluster
        uint32_t reference;
    };

    explicit Stepper(const QuantizedShortForm& form)
        : form_(form), slots_(form.slots().data()), firstLeaf_(form.firstLeaf()) {}

    RayFrame prepare(const PreparedRay& ray) const { return {ray, form_.bounds()}; }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const RayFrame& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval part = ray.clip(ray.root(), tLimit);
        root = {{ray.root(), 0, 0, form_.slots().empty() ? firstLeaf_ : 0}, part.enter};
        return !part.isEmpty();
    }

    /// The arithmetic is that of the quantized form.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                         Entered<Cursor>& next, Entered<Cursor>*& top, Metrics& metrics) const {
        uint32_t firstSlot = from.cursor.firstSlot, firstEntry = from.cursor.firstEntry;
        const ShortRecord* record = fetch(firstSlot + from.cursor.reference, metrics);
        if (record->isGlue()) [[unlikely]] {
            firstSlot = form_.firstSlotOf(record->line());
            firstEntry = record->firstEntry();
            record = fetch(firstSlot, metrics);
        }
        metrics.boxesTested(1, BoxTestCost{11, 12});
        metrics.boxesTested(1, BoxTestCost{10, 12});
        PlacedBox left, right;
        placeChildren(*record, from.cursor.box, left, right);
        const EnteredOfTwo found = ray.clip(left, right, tLimit);
        const auto enter = [&](uint32_t child, Entered<Cursor>& entered) HWY_ATTR {
            entered = {{child == 0 ? left : right, firstSlot, firstEntry, record->reference(child)},
                       found.enter[child]};
        };
        return enterInOrder(found, enter, next, top, metrics);
    }

    HWY_INLINE bool isLeaf(const Cursor& cursor) const { return cursor.reference >= firstLeaf_; }
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor) const {
        const uint32_t first = form_.firstEntryOf(cursor.firstEntry, cursor.reference);
        return {first, form_.countFrom(first)};
    }
    /// Does the same, and reports the words of the bitmap, which comes after the slots.
    template <class Metrics>
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor, Metrics& metrics) const {
        const PrimitiveRange range = primitiveRange(cursor);
        if (!form_.lastEntries().empty())
            metrics.recordFetched(
                form_.slots().size() * sizeof(ShortRecord) + range.first / 32 * sizeof(uint32_t),
                2 * sizeof(uint32_t));
        return range;
    }

  private:
    template <class Metrics>
    HWY_INLINE const ShortRecord* fetch(uint32_t slot, Metrics& metrics) const {
        metrics.recordFetched(slot * sizeof(ShortRecord), sizeof(ShortRecord));
        return slots_ + slot;
    }

    /// Places the boxes of the children. Insets become fractions without being shifted in their word: a
    /// number n 2^k is exact, and so is its product with 2^-(6 + k).
    HWY_INLINE void placeChildren(const ShortRecord& record, const PlacedBox& box, PlacedBox& left,
                                  PlacedBox& right) const {
        const FourInts insets{63, 63 << 6, 63 << 12, 0};
        const FourInts owners{1 << 18, 1 << 19, 1 << 20, 0};
        const Four unit{0x1p-6f, 0x1p-12f, 0x1p-18f, 0};
        const FourInts mins = FourInts{} + int32_t(record.words()[0]);
        const FourInts maxs = FourInts{} + int32_t(record.words()[1]);
        placeSiblings(box, __builtin_convertvector(mins & insets, Four) * unit,
                      __builtin_convertvector(maxs & insets, Four) * unit, (mins & owners) == owners,
                      (maxs & owners) == owners, left, right);
    }

    const QuantizedShortForm& form_;
    const ShortRecord* slots_;
    uint32_t firstLeaf_;
};
static_assert(SteppableTree<Stepper<QuantizedShortForm>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
