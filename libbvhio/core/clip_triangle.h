// The bounds of the part of a triangle inside a box, for spatial splits: clipping by half-spaces (Sutherland
// and Hodgman 1974, "Reentrant Polygon Clipping") in double, with a margin that makes the bounds safe.
//
// Why the parts of a triangle find all hits that the whole triangle finds (core/intersect.h). A hit's exact
// point P on the ray lies near an exact point Q of the triangle. On each axis their distance is at most 2^-51
// of the triangle's largest coordinate, because the sheared vertices are rounded to that, plus an equal
// fraction of the distance to the origin along that axis, which the slack of the box test covers. Follow Q
// down the splits to a part that lies on Q's side of each plane. Clipping keeps Q within rounding: on every
// axis each crossing is within 2^-51 of the largest coordinate of its exact position, since the points it is
// computed from are in the plane up to the same error. Before clipping, the planes are moved out by kMargin =
// 2^-40 of the largest coordinate, so that no such error cuts Q off. The corners' bounds are moved out by the
// margin again and rounded outwards. So the part's box holds everything within almost a margin of Q, and so
// P, except beyond the triangle's own bounds, where a hit by definition has passed the test. A float's
// spacing is 2^-24 of its value, so the margin rarely moves a bound by more than one float.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/triangle.h"

namespace bvhio {

namespace detail {

/// Returns the largest float that is not above `x`, which must be in the range of finite floats. Never
/// returns -0.
inline float roundedDown(double x) {
    const auto nearest = float(x);
    return (nearest > x ? std::nextafterf(nearest, -std::numeric_limits<float>::infinity()) : nearest) + 0.0f;
}
inline float roundedUp(double x) {
    const auto nearest = float(x);
    return (nearest < x ? std::nextafterf(nearest, std::numeric_limits<float>::infinity()) : nearest) + 0.0f;
}

}  // namespace detail

/// Returns the overlap of two boxes, which is empty if they don't touch.
constexpr Aabb intersection(const Aabb& a, const Aabb& b) {
    return {max(a.min, b.min), min(a.max, b.max)};
}

/// Returns the bounds of the part of a triangle inside the closed box `within`. They may exceed `within` by a
/// float or two, and never exceed the triangle's bounds. They are empty if the triangle does not touch the
/// box.
inline Aabb partBounds(const Triangle& triangle, const Aabb& within) {
    struct Point {
        double at[3];
    };
    // Each of the six planes adds at most one corner to a convex polygon. Rounding may make it slightly
    // concave, so there is room for more corners. If even that is too little, the triangle's bounds are
    // returned.
    constexpr int kCapacity = 12;
    constexpr double kMargin = 0x1p-40;

    const Aabb whole = bounds(triangle);
    double largest = 0;  // coordinate
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(double(whole.min[axis])), std::abs(double(whole.max[axis]))});
    const double margin = kMargin * largest;

    Point buffers[2][kCapacity];
    Point* points = buffers[0];
    Point* kept = buffers[1];
    int count = 3;
    const Vec3* corners[3] = {&triangle.v0, &triangle.v1, &triangle.v2};
    for (int i = 0; i < 3; ++i) points[i] = {{corners[i]->x, corners[i]->y, corners[i]->z}};

    bool overflow = false;
    const auto cut = [&](int axis, double plane, double side) {
        int keptCount = 0;
        const auto keep = [&](const Point& p) {
            if (keptCount < kCapacity)
                kept[keptCount++] = p;
            else
                overflow = true;
        };
        const Point* from = points + count - 1;
        double a = side * (from->at[axis] - plane);
        for (int i = 0; i < count; ++i) {
            const Point* to = points + i;
            const double b = side * (to->at[axis] - plane);
            if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
                const double t = a / (a - b);
                Point crossing;
                for (int k = 0; k < 3; ++k) crossing.at[k] = from->at[k] + t * (to->at[k] - from->at[k]);
                crossing.at[axis] = plane;
                keep(crossing);
            }
            if (b >= 0) keep(*to);
            from = to;
            a = b;
        }
        std::swap(points, kept);
        count = keptCount;
    };
    for (int axis = 0; axis < 3 && count > 0; ++axis) {
        if (whole.min[axis] < within.min[axis]) cut(axis, within.min[axis] - margin, 1);
        if (whole.max[axis] > within.max[axis] && count > 0) cut(axis, within.max[axis] + margin, -1);
    }
    if (count == 0) return Aabb::empty();
    if (overflow) return whole;

    Aabb part;
    for (int axis = 0; axis < 3; ++axis) {
        double low = points[0].at[axis], high = low;
        for (int i = 1; i < count; ++i) {
            low = std::min(low, points[i].at[axis]);
            high = std::max(high, points[i].at[axis]);
        }
        part.min[axis] = std::max(detail::roundedDown(low - margin), whole.min[axis]);
        part.max[axis] = std::min(detail::roundedUp(high + margin), whole.max[axis]);
    }
    return part;
}

}  // namespace bvhio
