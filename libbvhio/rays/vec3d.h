// Vec3 in double, for values that are computed once per ray and then rounded: bases, normals, hit points.
#pragma once

#include <cmath>
#include <limits>

#include "core/vec3.h"

namespace bvhio {

/// A point or a direction in double. Only + - * / and sqrt are used, which IEEE 754 rounds the same way on
/// every machine.
struct Vec3d {
    double x = 0, y = 0, z = 0;

    constexpr Vec3d() = default;
    constexpr Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit Vec3d(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
    constexpr explicit operator Vec3() const { return {float(x), float(y), float(z)}; }
};

inline constexpr double kLargestFloat = std::numeric_limits<float>::max();

/// Rounds to float. Values that would overflow become the largest float.
constexpr Vec3 clampToFloat(Vec3d p) {
    const auto clamp = [](double x) {
        return x < -kLargestFloat ? -kLargestFloat : x > kLargestFloat ? kLargestFloat : x;
    };
    return Vec3(Vec3d(clamp(p.x), clamp(p.y), clamp(p.z)));
}

constexpr Vec3d operator+(Vec3d a, Vec3d b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3d operator-(Vec3d a, Vec3d b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3d operator*(Vec3d a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr double dot(Vec3d a, Vec3d b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3d a) {
    return std::sqrt(dot(a, a));
}
/// Returns the unit vector along `a`, or zero for the zero vector. In double, products of floats neither
/// overflow nor vanish.
inline Vec3d normalize(Vec3d a) {
    const double l = length(a);
    return l > 0 ? Vec3d{a.x / l, a.y / l, a.z / l} : a;
}

}  // namespace bvhio
