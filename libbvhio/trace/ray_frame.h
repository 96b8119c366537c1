// Planes as a ray sees them, for the forms that store a child's planes as fractions of its parent's box.
//
// A ray meets the plane p of an axis at the parameter (p - origin) / direction, which is linear in p. So if a
// plane of a child is at the fraction f of its parent's box, its parameter is at the same fraction between
// the parameters of the parent's planes. A step down the tree computes it from these by one product and one
// sum, and no box is ever rebuilt in coordinates. (The idea is from K. Vaidyanathan, T. Akenine-Moeller, M.
// Salvi, "Watertight Ray Traversal with Reduced Precision", HPG 2016. There the ray's parameters are rounded
// at every step.)
//
// The difficulty is rounding: a computed plane must never be inside its box, or hits are lost. Rounding each
// new plane outwards does not work, because a plane that was moved outwards moves the planes on the other
// side that are computed from it inwards. So planes are only rounded to nearest on the way down. Their errors
// are not amplified, since each new plane is an average of its parent's two planes. They only add up, and
// stay below a margin that is known when the ray starts. The boxes that are tested are larger by this margin.
//
// Lemma. Let u = 2^-24. On one axis, let T(p) be what this file calls the place of p: exactly (p - origin) /
// direction for a regular ray, and p - origin for other rays. Let M be the largest |place| of the root's
// two planes, as computed, and m = 2^-17 M + 2^-120 the margin, taken with the direction's sign. Let `min`,
// `max` be the places of a box's planes as this file and at most 96 steps compute them, where a step replaces
// min by min + f size, or max by max - f size, or both from the same size = max - min, with f in [0, 1], the
// sum of both f at most 1 and a relative error of the product of at most 3 u; and let P, Q be the planes that
// the same steps find from the root's, with exact arithmetic. If the ray goes up the axis:
//     min <= T(P) - 19 u M   and   max + 2 m >= T(Q) + 19 u M;
// If it goes down, the same holds with the signs swapped. Proof. All places are stored shifted by -m, which
// does not change sizes. Write min = T(P) - m + a and max
// = T(Q) - m + b. At the root |a|, |b| <= R0 = 4.2 u M: a place is rounded at most three times, the
// subtraction of m once. With S = T(Q) - T(P), size is S + b - a with a relative error u, f size has at most
// 4.1 u (S + |b - a|) f, and the sum adds at most u M (1 + 2^-15). So the new a' is (1 - f) a + f b with an
// error of at most 4.1 u f S + u M (1 + 2^-14): the first part is an average, which does not exceed the
// larger of the two; the second adds up to at most 4.1 u S0 <= 8.3 u M over all steps, as each step takes at
// least f S off the size; the third to at most 96.1 u M. Together |a|, |b| <= (4.2 + 8.3 + 96.1) u M < 108.7
// u M, while m >= 128 u M. The sum max + 2 m is rounded by at most u M more. Underflow, of at most 2^-140 a
// step, is covered by the 2^-120 in m. If f is 0 the plane stays as it is. QED.
//
// What follows for a form. Let a node's stored box be what the same fractions give in binary64 from the
// root's box (compress/inset_box.h); its planes differ from the exact P, Q by less than u M / 4 in places.
// Let B be a box of floats that lies in the stored box. clipToBox finds for a plane p of B the parameter T(p)
// with an error of at most 13 u |T(p)|: 8 u of slack and four roundings (and 2^-149 of underflow). So a
// parameter found here lies before it where the ray enters and behind it where it leaves: whenever clipToBox
// accepts B, the intersection of the intervals found here is not empty, and begins no later. For a ray that
// is not regular, places are multiplied by the same reciprocals as differences are in clipToBox, and rounding
// is monotone.
// Per target, like trace/traverse.h.
#if defined(BVHIO_TRACE_RAY_FRAME_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_RAY_FRAME_H
#undef BVHIO_TRACE_RAY_FRAME_H
#else
#define BVHIO_TRACE_RAY_FRAME_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstring>
#include <limits>

#include "core/intersect.h"
#include "trace/stepper.h"
#include "tree/bvh.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// Lanes for x, y, z and one more number.
using Four = float __attribute__((vector_size(16)));
/// The same for whole numbers, or for masks, where -1 is true.
using FourInts = int32_t __attribute__((vector_size(16)));

/// Like the processor's instructions, gives b if either is a NaN.
HWY_INLINE Four min(Four a, Four b) {
#if defined(__SSE__)
    return Four(_mm_min_ps(__m128(a), __m128(b)));
#else
    return a < b ? a : b;
#endif
}
HWY_INLINE Four max(Four a, Four b) {
#if defined(__SSE__)
    return Four(_mm_max_ps(__m128(a), __m128(b)));
#else
    return a > b ? a : b;
#endif
}

/// The places of a box's planes, shifted by the margin, which a traversal stores instead of the box. Lane 3
/// of both is the start of the ray.
struct PlacedBox {
    Four min, max;

    /// Returns the distances of the planes: negative if the ray goes down an axis, and 0 in lane 3.
    HWY_INLINE Four size() const { return max - min; }
};

/// Returns `of` in the lanes whose bits are all set in the mask, and 0 in the others. andNot does the
/// reverse.
HWY_INLINE Four where(FourInts mask, Four of) {
    return Four(FourInts(of) & mask);
}
HWY_INLINE Four andNot(FourInts mask, Four of) {
#if defined(__SSE__)
    return Four(_mm_andnot_ps(__m128(mask), __m128(of)));  // g++ makes a slow blend of the line below
#else
    return Four(FourInts(of) & ~mask);
#endif
}

/// Computes the boxes of two siblings that share the planes of their parent's `box`. On each side, one
/// sibling keeps the parent's plane. The plane of the other one, which is the right sibling if the mask is
/// set, moves inwards by a fraction of the box's size. Everything that does not need `box` is done first,
/// because a ray on its way down waits for one box after another.
HWY_INLINE void placeSiblings(const PlacedBox& box, Four minFractions, Four maxFractions,
                              FourInts minIsRights, FourInts maxIsRights, PlacedBox& left, PlacedBox& right) {
    const Four size = box.size();
    left.min = box.min + andNot(minIsRights, minFractions) * size;
    left.max = box.max - andNot(maxIsRights, maxFractions) * size;
    right.min = box.min + where(minIsRights, minFractions) * size;
    right.max = box.max - where(maxIsRights, maxFractions) * size;
}

/// The boxes that a ray enters, of two.
struct EnteredOfTwo {
    Four enter;        // where, in lanes 0 and 1
    uint32_t entered;  // bit 0: the first, bit 1: the second
};

/// Ends a step to two children: writes the nearer one to `next`, and pushes the farther one. `enter(child,
/// entered)` writes a child. Returns false if neither is entered.
template <class Cursor, class Enter, class Metrics>
HWY_INLINE bool enterInOrder(const EnteredOfTwo& found, const Enter& enter, Entered<Cursor>& next,
                             Entered<Cursor>*& top, Metrics& metrics) {
    switch (found.entered) {
        case 0:
            return false;
        case 1:
            enter(0, next);
            return true;
        case 2:
            enter(1, next);
            return true;
        default:
            if (found.enter[1] < found.enter[0]) {
                enter(0, *top++);
                enter(1, next);
            } else {
                enter(1, *top++);
                enter(0, next);
            }
            metrics.pushed(sizeof(Entered<Cursor>));
            return true;
    }
}

/// Computes the places of planes for a ray. A ray is regular unless a component of its direction is zero or
/// extreme, or the root's box is extremely far away. For regular rays places are parameters.
class RayFrame {
  public:
    /// Makes a frame for a tree whose root has `bounds`.
    HWY_INLINE RayFrame(const PreparedRay& ray, const Aabb& bounds) : ray_(ray) {
        const Four origin{ray.origin.x, ray.origin.y, ray.origin.z, 0};
        const Four direction{ray.direction.x, ray.direction.y, ray.direction.z, 1};
        const Four lower = Four{bounds.min.x, bounds.min.y, bounds.min.z, ray.tMin} - origin;
        const Four upper = Four{bounds.max.x, bounds.max.y, bounds.max.z, ray.tMin} - origin;
        const Four reciprocal = 1.0f / direction;
        const Four length = max(direction, -direction);
        const Four first = lower * reciprocal, last = upper * reciprocal;
        const Four farther = max(max(first, -first), max(last, -last));
        regular_ = areAll((length >= 1 / kFar) & (length <= kFar) & (farther <= kFar));
        if (regular_)
            shift(first, last, Four((FourInts(direction) & kSign) | FourInts(marginOf(farther))), ray.tMin);
        else
            setIrregular(lower, upper);
    }

    bool isRegular() const { return regular_; }
    const PreparedRay& ray() const { return ray_; }
    const PlacedBox& root() const { return root_; }

    /// Places another box inside the root's box. It is as good a start for the lemma as the root's box: there
    /// is no more rounding, and its places are not larger.
    PlacedBox place(const Aabb& box) const {
        Four first{box.min.x - ray_.origin.x, box.min.y - ray_.origin.y, box.min.z - ray_.origin.z, 0};
        Four last{box.max.x - ray_.origin.x, box.max.y - ray_.origin.y, box.max.z - ray_.origin.z, 0};
        if (regular_) {
            const Four reciprocal = 1.0f / Four{ray_.direction.x, ray_.direction.y, ray_.direction.z, 1};
            first *= reciprocal;
            last *= reciprocal;
        } else {
            for (int axis = 0; axis < 3; ++axis)
                if (unbounded_[size_t(axis)] != 0) first[axis] = last[axis] = 0;
        }
        const Four margin = twiceMargin_ * 0.5f;
        PlacedBox placed{first - margin, last - margin};
        placed.min[3] = placed.max[3] = root_.min[3];
        return placed;
    }

    /// Returns the part of a regular ray inside the box, up to `tLimit`.
    HWY_INLINE RayInterval clipRegular(const PlacedBox& box, float tLimit) const {
        const Four first = box.min, last = box.max + twiceMargin_;
        const Four near = min(first, last), far = max(first, last);
        const auto larger = [](float a, float b) { return a > b ? a : b; };
        const auto smaller = [](float a, float b) { return a < b ? a : b; };
        return {larger(larger(near[0], near[1]), larger(near[2], near[3])),
                smaller(smaller(far[0], far[1]), smaller(far[2], tLimit))};
    }

    /// Returns which of two boxes a regular ray enters before `tLimit`, and where.
    HWY_INLINE EnteredOfTwo clipRegular(const PlacedBox& a, const PlacedBox& b, float tLimit) const {
#if defined(__SSE__)
        const Four lastA = a.max + twiceMargin_, lastB = b.max + twiceMargin_;
        const __m128 nearA(min(a.min, lastA)), farA(max(a.min, lastA));
        const __m128 nearB(min(b.min, lastB)), farB(max(b.min, lastB));
        __m128 enter = _mm_max_ps(_mm_unpacklo_ps(nearA, nearB), _mm_unpackhi_ps(nearA, nearB));
        __m128 exit = _mm_min_ps(_mm_unpacklo_ps(farA, farB), _mm_unpackhi_ps(farA, farB));
        enter = _mm_max_ps(enter, _mm_movehl_ps(enter, enter));
        exit = _mm_min_ps(_mm_min_ps(exit, _mm_movehl_ps(exit, exit)), _mm_set1_ps(tLimit));
        return {Four(enter), uint32_t(_mm_movemask_ps(_mm_cmple_ps(enter, exit))) & 3};
#else
        return bothOf(clipRegular(a, tLimit), clipRegular(b, tLimit));
#endif
    }

    /// Does the same for a ray that is not regular. Its places are differences to the origin, which
    /// clipToPlanes multiplies by the reciprocals.
    RayInterval clipIrregular(const PlacedBox& box, float tLimit) const {
        const Four first = box.min, last = box.max + twiceMargin_;
        RayInterval part{ray_.tMin, tLimit};
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = ray_.nearPlane[axis] >= 3;
            const float none = unbounded_[size_t(axis)];
            const float near = (backwards ? last : first)[axis] * ray_.nearReciprocal[axis] + none;
            const float far = (backwards ? first : last)[axis] * ray_.farReciprocal[axis] + none;
            part.enter = near > part.enter ? near : part.enter;
            part.exit = far < part.exit ? far : part.exit;
        }
        return part;
    }
    EnteredOfTwo clipIrregular(const PlacedBox& a, const PlacedBox& b, float tLimit) const {
        return bothOf(clipIrregular(a, tLimit), clipIrregular(b, tLimit));
    }

    /// Does the same for any ray.
    HWY_INLINE RayInterval clip(const PlacedBox& box, float tLimit) const {
        return regular_ ? clipRegular(box, tLimit) : clipIrregular(box, tLimit);
    }
    HWY_INLINE EnteredOfTwo clip(const PlacedBox& a, const PlacedBox& b, float tLimit) const {
        return regular_ ? clipRegular(a, b, tLimit) : clipIrregular(a, b, tLimit);
    }

  private:
    static constexpr FourInts kSign{INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
    static constexpr float kFar = 0x1p100f;
    static_assert(kMaxDepth <= 96, "the margin is for 96 steps");

    static HWY_INLINE Four marginOf(Four farther) {
        return farther * 0x1p-17f + 0x1p-120f;
    }
    static HWY_INLINE bool areAll(FourInts lanes) {
#if defined(__SSE__)
        return _mm_movemask_ps(__m128(lanes)) == 15;
#else
        return (lanes[0] & lanes[1] & lanes[2] & lanes[3]) != 0;
#endif
    }
    static EnteredOfTwo bothOf(const RayInterval& a, const RayInterval& b) {
        return {Four{a.enter, b.enter, 0, 0}, uint32_t(!a.isEmpty()) | uint32_t(!b.isEmpty()) << 1};
    }

    HWY_INLINE void shift(Four first, Four last, Four margin, float start) {
        root_ = {first - margin, last - margin};
        twiceMargin_ = margin + margin;
        // Lane 3 has no size, so it never changes. For a test, it reaches from the start to infinity.
        root_.min[3] = root_.max[3] = start;
        twiceMargin_[3] = std::numeric_limits<float>::max();
    }

    [[gnu::noinline]] void setIrregular(Four first, Four last) {
        Four farther = max(max(first, -first), max(last, -last));
        for (int axis = 0; axis < 3; ++axis)
            if (!(farther[axis] <= kFar)) {
                // It may be infinite, so such an axis does not clip (a NaN fails each comparison).
                first[axis] = last[axis] = farther[axis] = 0;
                unbounded_[size_t(axis)] = std::numeric_limits<float>::quiet_NaN();
            }
        shift(first, last, marginOf(farther), 0);
    }

    const PreparedRay& ray_;
    PlacedBox root_;
    Four twiceMargin_;
    bool regular_;
    std::array<float, 3> unbounded_{};  // a NaN for an axis that does not clip
};

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
