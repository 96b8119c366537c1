// Clips a triangle exactly to axis-aligned boxes: clipping by half-spaces (Sutherland and Hodgman 1974,
// "Reentrant Polygon Clipping") of one convex polygon, in double.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/triangle.h"

namespace bvhio {

/// A planar convex polygon: a triangle, or the part of a triangle inside closed boxes. A part that lies in a
/// face of a box, or in a flat box, is inside. If only an edge or a corner touches a box, the area is 0.
class ConvexPolygon {
  public:
    explicit ConvexPolygon(const Triangle& t) : size_(3) {
        const Vec3 corners[3] = {t.v0, t.v1, t.v2};
        for (int i = 0; i < 3; ++i) points_[i] = {corners[i].x, corners[i].y, corners[i].z};
        double normal[3];
        for (int axis = 0; axis < 3; ++axis) normal[axis] = 2 * projectedArea(axis);
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(normal[axis]) > std::abs(normal[projection_])) projection_ = axis;
        const double length =
            std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        scale_ = length > 0 ? length / normal[projection_] : 0;
        findBounds();
        area_ = 0.5 * length;
    }

    double area() const { return area_; }
    bool isEmpty() const { return size_ < 3; }

    enum class Place { inside, outside, crossing };
    /// Returns `inside` if all of the polygon is inside the box, `outside` if its bounds are outside, and
    /// else `crossing`.
    Place placeIn(const Aabb& box) const {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = box.min[axis], high = box.max[axis];
            if (max_[axis] < low || min_[axis] > high) return Place::outside;
            inside &= min_[axis] >= low && max_[axis] <= high;
        }
        return inside ? Place::inside : Place::crossing;
    }

    /// Returns the part inside `box`. If it is empty, its area is 0.
    ConvexPolygon clippedTo(const Aabb& box) const {
        ConvexPolygon result = *this;
        for (int axis = 0; axis < 3 && !result.isEmpty(); ++axis) {
            if (min_[axis] < box.min[axis]) result.cut(axis, box.min[axis], 1);
            if (max_[axis] > box.max[axis]) result.cut(axis, box.max[axis], -1);
        }
        result.area_ = 0;
        if (result.isEmpty()) return result;
        result.findBounds();
        // In spite of rounding, a part must not have more area than the whole, or a negative area.
        result.area_ = std::min(area_, std::max(0.0, scale_ * result.projectedArea(projection_)));
        return result;
    }

  private:
    // A triangle clipped to the six planes of a box has at most 9 corners.
    static constexpr int kCapacity = 12;
    struct Point {
        double at[3];
    };

    /// Keeps the part with side * coordinate >= side * plane.
    void cut(int axis, double plane, double side) {
        Point kept[kCapacity];
        int count = 0;
        // Rounding may leave the polygon slightly concave. A plane through such a place adds corners that
        // almost coincide, so dropping those beyond the capacity loses almost no area.
        const auto keep = [&](const Point& p) {
            if (count < kCapacity) kept[count++] = p;
        };
        for (int i = 0; i < size_; ++i) {
            const Point& from = points_[i];
            const Point& to = points_[i + 1 < size_ ? i + 1 : 0];
            const double a = side * (from.at[axis] - plane), b = side * (to.at[axis] - plane);
            if (a >= 0) keep(from);
            if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
                const double t = a / (a - b);
                Point crossing;
                for (int k = 0; k < 3; ++k) crossing.at[k] = from.at[k] + t * (to.at[k] - from.at[k]);
                crossing.at[axis] = plane;
                keep(crossing);
            }
        }
        size_ = count;
        std::copy(kept, kept + count, points_);
    }

    void findBounds() {
        for (int axis = 0; axis < 3; ++axis) {
            min_[axis] = max_[axis] = points_[0].at[axis];
            for (int i = 1; i < size_; ++i) {
                min_[axis] = std::min(min_[axis], points_[i].at[axis]);
                max_[axis] = std::max(max_[axis], points_[i].at[axis]);
            }
        }
    }

    /// Returns the signed area of the projection along `axis`.
    double projectedArea(int axis) const {
        const int u = axis == 0 ? 1 : axis == 1 ? 2 : 0, v = axis == 0 ? 2 : axis == 1 ? 0 : 1;
        const Point& origin = points_[0];
        double sum = 0;
        for (int i = 1; i + 1 < size_; ++i) {
            const Point &a = points_[i], &b = points_[i + 1];
            sum += (a.at[u] - origin.at[u]) * (b.at[v] - origin.at[v]) -
                   (a.at[v] - origin.at[v]) * (b.at[u] - origin.at[u]);
        }
        return 0.5 * sum;
    }

    Point points_[kCapacity];
    int size_;
    int projection_ = 0;   // the axis along which the triangle's projection is largest
    double scale_, area_;  // area per projected area
    double min_[3], max_[3];
};

}  // namespace bvhio
