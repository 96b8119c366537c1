// Vectors of three floats, with the few operations that a BVH needs.
#pragma once

#include <cmath>
#include <cstdint>

namespace bvhio {

/// A point or a direction; 12 bytes, plain data, stored as is in files.
struct Vec3 {
    float x = 0, y = 0, z = 0;

    /// Returns the component of an axis: 0 = x, 1 = y, 2 = z.
    constexpr float& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr float operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
};
static_assert(sizeof(Vec3) == 12);

/// Returns the component of an axis that is not known when compiling: by one indexed load, where operator[]
/// compares and branches.
inline float component(const Vec3& a, int axis) {
    return (&a.x)[axis];
}

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator*(Vec3 a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr float dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
/// Returns the unit vector along `a`, or zero for the zero vector.
inline Vec3 normalize(Vec3 a) {
    const float l = length(a);
    return l > 0 ? a * (1.0f / l) : a;
}
// These are comparisons, not std::min: the order of the operands must not vary by compiler.
constexpr Vec3 min(Vec3 a, Vec3 b) {
    return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
constexpr Vec3 max(Vec3 a, Vec3 b) {
    return {b.x > a.x ? b.x : a.x, b.y > a.y ? b.y : a.y, b.z > a.z ? b.z : a.z};
}
inline bool isFinite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace bvhio
