// The planes of two siblings as insets from their parent's, for the forms whose records share them. A Record
// has inset(side), ownerIsRight(side) and setPlane(side, inset, ownerIsRight); sides are min xyz, max xyz.
#pragma once

#include <algorithm>
#include <cstdint>

#include "compress/inset_box.h"

namespace bvhio {

/// A box whose sides can be moved inwards by up to 2^bits - 1 steps. Coordinates of sides 3 to 5 are negated
/// here, so that larger coordinates are further inside for all sides.
class InsetGrid {
  public:
    /// Insets are measured from `frame`. `bounds`, the box of the tree's root, lies in it.
    InsetGrid(const InsetFrame& frame, const InsetBox& box, const Aabb& bounds, uint32_t bits)
        : box_(box), bounds_(bounds), most_((1u << bits) - 1) {
        for (int axis = 0; axis < 3; ++axis) {
            step_[axis] = frame.size(box, axis) / double(1u << bits);
            root_[axis] = frame.bounds().min[axis];
            root_[axis + 3] = -frame.bounds().max[axis];
        }
    }

    /// Returns the box of a child.
    template <class Record>
    InsetBox child(const Record& record, uint32_t child) const {
        InsetBox result = box_;
        for (uint32_t side = 0; side < 6; ++side) {
            double* const insets = side < 3 ? result.min : result.max;
            if (uint32_t(record.ownerIsRight(side)) == child)
                insets[side % 3] = inset(side, record.inset(side));
        }
        return result;
    }

    /// Sets the planes of a record for two boxes. On each side, the box that lies further inside gets the
    /// plane, as far inwards as it still holds the box.
    template <class Record>
    void setPlanes(Record& record, const Aabb& left, const Aabb& right) const {
        double stepsOfUnit[3];
        for (int axis = 0; axis < 3; ++axis) stepsOfUnit[axis] = 1 / step_[axis];
        for (uint32_t side = 0; side < 6; ++side) {
            const double start = plane(side, 0);
            const double outermost = std::max<double>(InsetFrame::upwards(start), coordinate(bounds_, side));
            const double toLeft = coordinate(left, side), toRight = coordinate(right, side);
            const bool ownerIsRight = toRight > toLeft;
            const double target = ownerIsRight ? toRight : toLeft;
            if (target <= outermost) continue;
            const double estimate = (target - start) * stepsOfUnit[side % 3];
            uint32_t steps = estimate < most_ ? uint32_t(estimate) : most_;
            while (steps > 0 && plane(side, steps) > target) --steps;
            while (steps < most_ && plane(side, steps + 1) <= target) ++steps;
            // Keep the parent's plane if the new one would cut no float off the box. So a decoded tree is
            // encoded to the same records again.
            if (plane(side, steps) > outermost) record.setPlane(side, steps, ownerIsRight);
        }
    }

  private:
    double inset(uint32_t side, uint32_t steps) const {
        return (side < 3 ? box_.min : box_.max)[side % 3] + steps * step_[side % 3];
    }
    double plane(uint32_t side, uint32_t steps) const { return root_[side] + inset(side, steps); }
    static double coordinate(const Aabb& box, uint32_t side) {
        return side < 3 ? box.min[int(side)] : -box.max[int(side) - 3];
    }

    const InsetBox& box_;
    const Aabb& bounds_;
    double step_[3], root_[6];
    uint32_t most_;
};

}  // namespace bvhio
