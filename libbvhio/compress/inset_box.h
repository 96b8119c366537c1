// The boxes of forms that store a child's planes as fractions of its parent's box: what exactly such a box
// is. A decoder must follow this bit by bit: binary64, round to nearest, no contraction.
//
// Planes are held as insets, how far they lie inside the root's box, so that rounding does not depend on
// where in space the scene lies: it is relative to the scene's size (trace/ray_frame.h relies on that). A
// fraction of 0 keeps a plane exactly.
#pragma once

#include <cmath>
#include <limits>

#include "core/aabb.h"

namespace bvhio {

/// How far the sides of a node's box lie inside those of the root's; all 0 is the root's box itself.
struct InsetBox {
    double min[3] = {}, max[3] = {};
};

/// The root's box, which insets are measured from.
class InsetFrame {
  public:
    explicit InsetFrame(const Aabb& bounds) : bounds_(bounds) {
        for (int axis = 0; axis < 3; ++axis) size_[axis] = double(bounds.max[axis]) - bounds.min[axis];
    }

    const Aabb& bounds() const { return bounds_; }
    /// Of a box, along an axis.
    double size(const InsetBox& box, int axis) const { return (size_[axis] - box.min[axis]) - box.max[axis]; }
    /// The coordinate of a side, by its inset.
    double minPlane(double inset, int axis) const { return bounds_.min[axis] + inset; }
    double maxPlane(double inset, int axis) const { return bounds_.max[axis] - inset; }

    /// The insets of a box within the root's: at most what they are exactly.
    InsetBox insets(const Aabb& box) const {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        InsetBox result;
        for (int axis = 0; axis < 3; ++axis) {
            result.min[axis] = double(box.min[axis]) - bounds_.min[axis];
            result.max[axis] = double(bounds_.max[axis]) - box.max[axis];
            while (minPlane(result.min[axis], axis) > box.min[axis])
                result.min[axis] = std::nextafter(result.min[axis], -kInfinity);
            while (maxPlane(result.max[axis], axis) < box.max[axis])
                result.max[axis] = std::nextafter(result.max[axis], -kInfinity);
        }
        return result;
    }

    /// The largest box of floats that lies in the box: every box of floats that lies in it lies in that.
    Aabb floats(const InsetBox& box) const {
        Aabb result;
        for (int axis = 0; axis < 3; ++axis) {
            result.min[axis] = upwards(minPlane(box.min[axis], axis));
            result.max[axis] = -upwards(-maxPlane(box.max[axis], axis)) + 0.0f;
        }
        return result;
    }

    /// The least float that is not below `x`, never -0.
    static float upwards(double x) {
        const auto nearest = float(x);
        const float result =
            nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
        return result + 0.0f;
    }

  private:
    Aabb bounds_;
    double size_[3];
};

}  // namespace bvhio
