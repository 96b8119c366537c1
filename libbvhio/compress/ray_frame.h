// Planes as a ray sees them: for the forms that store a child's planes as fractions of its parent's box.
//
// A ray meets the plane p of an axis at the parameter (p - origin) / direction, which is linear in p. So if a
// plane of a child lies at the fraction f of its parent's box, its parameter lies at the same fraction
// between the parameters of the parent's planes: a step down the tree finds it from those by one product and
// one sum, and no box in coordinates is ever rebuilt (K. Vaidyanathan, T. Akenine-Moeller, M. Salvi,
// "Watertight Ray Traversal with Reduced Precision", HPG 2016, has the idea; there the ray's parameters are
// rounded at every step).
//
// The difficulty is rounding: a plane must never be found inside its box, or hits are lost. Rounding each new
// plane outwards does not work, as a plane that was moved outwards pushes the planes of the far side that are
// found from it inwards. We shift all planes of a ray outwards by one margin, once, and take it off again
// where the size of a box is needed. What remains is plain rounding, which cannot grow: each new plane is an
// average of its parent's two. The margin is larger than all that can add up on the way down.
//
// Lemma. Let u = 2^-24, and on one axis let T(p) be what this file calls the place of p: exactly (p - origin)
// / direction, for a ray that is regular, p - origin for others. Let M be the largest |place| of the root's
// two planes, as computed, and m = 2^-17 M + 2^-120 the margin. Let `min`, `max` be places of a box's planes
// as this file's functions compute them, after at most 96 steps, each of which replaces min by min + f size
// or max by max - f size, or both (from the same size), with f in [0, 1] and the sum f of both at most 1; and
// let P, Q be the exact planes that the same steps find from the root's, with exact arithmetic. If the ray
// goes up the axis:
//     min <= T(P) - 21 u M   and   max >= T(Q) + 21 u M;
// if it goes down, the same holds with the signs swapped.
// Proof. Write min = T(P) - m + a and max = T(Q) + m + b. At the root |a|, |b| <= R0 = 4.2 u M: the place is
// rounded at most three times, the subtraction of m once. With S = T(Q) - T(P), size = ((max - min) - 2 m)
// has two roundings of relative size u, so it is S + b - a with an error of at most 2 u S + 2^-14 u M (2 m is
// exact; m and a are below 2^-16 M). The product with f adds at most u f S, the sum at most u M (1 +
// 2^-13), and underflow at most 2^-140, which the term 2^-120 of m pays for. So the new a' is
// (1 - f) a + f b with an error of at most 3 u f S + u M (1 + 2^-12): the first part is an average, which
// does not exceed the larger of the two; the second adds up to at most 3 u S0 <= 6.1 u M over all steps, as
// each step takes at least f S off the size; the third to at most 96.1 u M. Together |a|, |b| <= (4.2 + 6.1
// + 96.1) u M < 107 u M, and m >= 128 u M. If f is 0 the plane is kept as it is. QED.
//
// What follows for a form: let a node's stored box be what the same fractions find in binary64 from the
// root's box (compress/inset_box.h); its planes differ from the exact P, Q by less than u M / 4 in places.
// Let B be a box of floats that lies in the stored box. clipToBox finds for a plane p of B the parameter T(p)
// with an error of at most 13 u |T(p)|: 8 u of slack and four roundings (and 2^-149 of underflow). So a
// parameter found here lies before it where the ray enters and behind it where it leaves: whenever clipToBox
// accepts B, the intersection of the intervals found here is not empty, and begins no later. For a ray that
// is not regular, places are multiplied by the same reciprocals as differences are in clipToBox, and rounding
// is monotone.
#pragma once

#include <array>
#include <cstring>
#include <limits>

#include "core/bvh.h"
#include "core/intersect.h"

namespace bvhio {

/// Lanes x, y, z and one more.
using Four = float __attribute__((vector_size(16)));

/// As the processor's instructions: b where either is a NaN.
BVHIO_INLINE Four min(Four a, Four b) {
#if defined(__SSE__)
    return Four(_mm_min_ps(__m128(a), __m128(b)));
#else
    return a < b ? a : b;
#endif
}
BVHIO_INLINE Four max(Four a, Four b) {
#if defined(__SSE__)
    return Four(_mm_max_ps(__m128(a), __m128(b)));
#else
    return a > b ? a : b;
#endif
}

/// The places of a box's planes, moved outwards by the margin. Lane 3 holds the ends of the ray itself.
struct PlacedBox {
    Four min, max;
};

/// Where a ray sees planes. A ray is regular unless a component of its direction is zero or extreme, or it
/// sees the root's box extremely far away; for regular rays places are parameters.
class RayFrame {
  public:
    /// A form's tree has `bounds` at its root.
    RayFrame(const PreparedRay& ray, const Aabb& bounds) : ray_(ray) {
        constexpr float kFar = 0x1p100f, kLast = std::numeric_limits<float>::max();
        const Four origin{ray.origin.x, ray.origin.y, ray.origin.z, 0};
        const Four direction{ray.direction.x, ray.direction.y, ray.direction.z, 1};
        const Four lower = Four{bounds.min.x, bounds.min.y, bounds.min.z, ray.tMin} - origin;
        const Four upper = Four{bounds.max.x, bounds.max.y, bounds.max.z, ray.tMin} - origin;
        const Four reciprocal = 1.0f / direction;
        const Four length = max(direction, -direction);
        Four first = lower * reciprocal, last = upper * reciprocal;
        Four largest = max(max(first, -first), max(last, -last));
        regular_ = areWithin(length, 1 / kFar, kFar) && areWithin(largest, 0, kFar);
        if (!regular_) {
            first = lower;
            last = upper;
            largest = max(max(first, -first), max(last, -last));
            for (int axis = 0; axis < 3; ++axis)
                if (!(largest[axis] <= kFar)) {
                    // Infinite, perhaps: such an axis says nothing (a NaN fails each comparison).
                    first[axis] = last[axis] = largest[axis] = 0;
                    unbounded_[size_t(axis)] = std::numeric_limits<float>::quiet_NaN();
                }
        }
        Four margin = largest * kMargin + 0x1p-120f;
        if (regular_)
            for (int axis = 0; axis < 3; ++axis) margin[axis] = std::copysign(margin[axis], direction[axis]);
        root_ = {first - margin, last + margin};
        twiceMargin_ = margin + margin;
        // Lane 3 has no size, so it stays as it is.
        root_.min[3] = regular_ ? ray.tMin : 0;
        root_.max[3] = kLast;
        twiceMargin_[3] = root_.max[3] - root_.min[3];
    }

    bool isRegular() const { return regular_; }
    const PreparedRay& ray() const { return ray_; }
    const PlacedBox& root() const { return root_; }

    /// How far a box's planes lie apart: the margin taken off. Negative where the ray goes down an axis.
    BVHIO_INLINE Four size(const PlacedBox& box) const { return (box.max - box.min) - twiceMargin_; }

    /// The part of a regular ray in the box, up to `tLimit`.
    static BVHIO_INLINE RayInterval clipRegular(const PlacedBox& box, float tLimit) {
        const Four near = min(box.min, box.max), far = max(box.min, box.max);
        const auto larger = [](float a, float b) { return a > b ? a : b; };
        const auto smaller = [](float a, float b) { return a < b ? a : b; };
        return {larger(larger(near[0], near[1]), larger(near[2], near[3])),
                smaller(smaller(far[0], far[1]), smaller(far[2], tLimit))};
    }

    /// The part of a ray that is not regular in the box, up to `tLimit`: places are differences to the
    /// origin, which is what clipToPlanes multiplies by the reciprocals.
    RayInterval clipIrregular(const PlacedBox& box, float tLimit) const {
        RayInterval part{ray_.tMin, tLimit};
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = ray_.nearPlane[axis] >= 3;
            const float none = unbounded_[size_t(axis)];
            const float near = (backwards ? box.max : box.min)[axis] * ray_.nearReciprocal[axis] + none;
            const float far = (backwards ? box.min : box.max)[axis] * ray_.farReciprocal[axis] + none;
            part.enter = near > part.enter ? near : part.enter;
            part.exit = far < part.exit ? far : part.exit;
        }
        return part;
    }

    /// The part of any ray in the box, up to `tLimit`.
    BVHIO_INLINE RayInterval clip(const PlacedBox& box, float tLimit) const {
        return regular_ ? clipRegular(box, tLimit) : clipIrregular(box, tLimit);
    }

  private:
    static constexpr float kMargin = 0x1p-17f;
    static_assert(kMaxDepth <= 96, "the margin is for 96 steps");

    static bool areWithin(Four v, float least, float most) {
        bool within = true;
        for (int lane = 0; lane < 4; ++lane) within &= v[lane] >= least && v[lane] <= most;
        return within;
    }

    const PreparedRay& ray_;
    PlacedBox root_;
    Four twiceMargin_;
    bool regular_;
    std::array<float, 3> unbounded_{};  // a NaN for an axis that says nothing
};

}  // namespace bvhio
