// The exact boxes of forms that store a child's planes as fractions of its parent's box. A decoder must
// compute them bit by bit like this: binary64, round to nearest, no contraction.
//
// A plane is held as an inset: its distance from the same side of the root's box, inwards. So rounding errors
// are relative to the scene's size, and do not depend on where in space the scene lies (trace/ray_frame.h
// relies on that). A fraction of 0 keeps a plane exactly.
#pragma once

#include <cmath>
#include <limits>

#include "core/aabb.h"

namespace bvhio {

/// The insets of a node's box, for each side. All of them are 0 for the root's box itself.
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
    /// Returns the size of a box along an axis.
    double size(const InsetBox& box, int axis) const { return (size_[axis] - box.min[axis]) - box.max[axis]; }
    /// Return the coordinate of a side with this inset.
    double minPlane(double inset, int axis) const { return bounds_.min[axis] + inset; }
    double maxPlane(double inset, int axis) const { return bounds_.max[axis] - inset; }

    /// Returns the insets of a box in the root's box, rounded down: the box never shrinks.
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

    /// Returns the largest box of floats in the box. It holds every box of floats in the box.
    Aabb floats(const InsetBox& box) const {
        Aabb result;
        for (int axis = 0; axis < 3; ++axis) {
            result.min[axis] = upwards(minPlane(box.min[axis], axis));
            result.max[axis] = -upwards(-maxPlane(box.max[axis], axis)) + 0.0f;
        }
        return result;
    }

    /// Returns the least float that is not below `x`, never -0.
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
