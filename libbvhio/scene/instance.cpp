#include "scene/instance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "scene/scene.h"

namespace bvhio {
namespace {

constexpr double kMargin = 0x1p-18;
constexpr float kLargest = std::numeric_limits<float>::max();

float roundDown(double value) {
    if (value <= -double(kLargest)) return -kLargest;
    if (value >= double(kLargest)) return kLargest;
    const float rounded = float(value);
    return (double(rounded) > value ? std::nextafter(rounded, -kLargest) : rounded) + 0.0f;
}
float roundUp(double value) {
    return -roundDown(-value) + 0.0f;
}

}  // namespace

Vec3 place(const Affine& m, Vec3 v) {
    const double x = v.x, y = v.y, z = v.z;
    const auto row = [&](size_t r) {
        return float(double(m[r]) * x + double(m[r + 1]) * y + double(m[r + 2]) * z + double(m[r + 3])) +
               0.0f;  // -0 + 0 is +0
    };
    return {row(0), row(4), row(8)};
}

std::optional<WorldToObject> inverse(const Affine& m) {
    for (const float number : m)
        if (!std::isfinite(number)) return {};
    const double a = m[0], b = m[1], c = m[2], d = m[4], e = m[5], f = m[6], g = m[8], h = m[9], i = m[10];
    const std::array<double, 9> cofactors{e * i - f * h, c * h - b * i, b * f - c * e,
                                          f * g - d * i, a * i - c * g, c * d - a * f,
                                          d * h - e * g, b * g - a * h, a * e - b * d};
    const double determinant = a * cofactors[0] + b * cofactors[3] + c * cofactors[6];
    if (determinant == 0) return {};
    WorldToObject result{{}, {m[3], m[7], m[11]}};
    for (size_t k = 0; k < 9; ++k) result.linear[k] = cofactors[k] / determinant;
    return result;
}

std::array<double, 3> placedMagnitude(const Affine& m, const Aabb& box) {
    std::array<double, 3> sums;
    for (size_t row = 0; row < 3; ++row) {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double largest =
                std::max(std::fabs(double(box.min[axis])), std::fabs(double(box.max[axis])));
            sum += std::fabs(double(m[4 * row + size_t(axis)])) * largest;
        }
        sums[row] = sum + std::fabs(double(m[4 * row + 3]));
    }
    return sums;
}

Aabb placedBox(const Affine& m, const Aabb& box) {
    const std::array<double, 3> magnitudes = placedMagnitude(m, box);
    Aabb result;
    for (int row = 0; row < 3; ++row) {
        // At one corner each term is least. Sums are monotone, so the sum is the least of the eight there.
        double low = 0, high = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double scale = m[size_t(4 * row + axis)];
            const double first = scale * double(box.min[axis]), second = scale * double(box.max[axis]);
            low += std::min(first, second);
            high += std::max(first, second);
        }
        const double translation = m[size_t(4 * row + 3)], margin = magnitudes[size_t(row)] * kMargin;
        result.min[row] = roundDown(low + translation - margin);
        result.max[row] = roundUp(high + translation + margin);
    }
    return result;
}

std::vector<InstanceEntry> instanceEntries(const Scene& scene) {
    std::vector<Aabb> boxes(scene.meshes.size());
    parallelChunks(boxes.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) boxes[i] = scene.boundsOf(scene.meshes[i]);
    });
    std::vector<InstanceEntry> entries(scene.instances.size());
    for (size_t i = 0; i < entries.size(); ++i) {
        const SceneInstance& instance = scene.instances[i];
        const SceneMesh& mesh = scene.meshes[instance.mesh];
        entries[i] = {*inverse(instance.objectToWorld),
                      placedBox(instance.objectToWorld, boxes[instance.mesh]), instance.mesh,
                      instance.firstPrimitive - mesh.firstTriangle};
    }
    return entries;
}

}  // namespace bvhio
