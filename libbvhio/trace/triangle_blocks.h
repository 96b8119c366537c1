// Triangles rearranged for tracing: a block for each leaf, in a layout for testing four triangles at once.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include "compress/form_concept.h"
#include "core/buffer.h"
#include "scene/scene.h"

namespace bvhio {

/// The blocks of all leaves. The block of a leaf with n triangles has 12 rows of n floats, with a column of
/// 48 bytes for each triangle. The block of the leaf that owns primitives[first, first + n) starts at float
/// 12 * first, without an index to look up and without padding.
///
/// A test reads four columns of a row at once, so in the last columns it also reads from the next row (and
/// masks these lanes out). Row 0 has the indices of triangles. They are biased so that they are not denormal
/// when they are read as floats: arithmetic on denormals is many times slower on some processors.
///
/// The last two rows bound the rounding errors of a test in float. Let u = 2^-24, half a unit in the last
/// place. The sheared coordinates of hitTriangle, computed in float, have errors of at most e = 6.1 u M,
/// where M bounds every coordinate of the triangle relative to the ray's origin. If hitTriangle accepts, they
/// are at most 2 L, where L is the longest side of the triangle's box. So each edge function, a difference of
/// two products of them, has an error of at most 12 e L + 2 e^2. A larger bound needs only two additions and
/// a product: (error + rayError) * (reach + rayError), with error + rayError = 25 u M and reach = 4 L +
/// error. M is split at a centre c that all blocks share,
/// |v - o| <= |v - c| + |o - c|: the first term is in `error`, the second in `rayError`.
class TriangleBlocks {
  public:
    enum Row : uint32_t { kIndexRow = 0, kVertexRows = 1, kErrorRow = 10, kReachRow = 11, kRowCount = 12 };
    static constexpr uint32_t kIndexBias = 0x00800000;

    /// `leaves` are the form's leaves, in any order; `primitives` its primitive array.
    TriangleBlocks(const Scene& scene, std::span<const uint32_t> primitives,
                   std::span<const PrimitiveRange> leaves);

    BVHIO_INLINE const float* block(uint32_t firstPrimitive) const {
        return data_.data() + size_t(kRowCount) * firstPrimitive;
    }
    /// Returns the ray's part of the error bound, for rays from `origin`.
    BVHIO_INLINE float rayError(Vec3 origin) const { return errorBound(largestComponent(origin - center_)); }
    size_t bytes() const { return data_.size() * sizeof(float); }

    /// Returns the triangle in column i of a block of n triangles.
    static BVHIO_INLINE Triangle triangle(const float* block, uint32_t n, uint32_t i) {
        const float* column = block + kVertexRows * size_t(n) + i;
        const auto vertex = [&](size_t v) {
            return Vec3{column[3 * v * n], column[(3 * v + 1) * n], column[(3 * v + 2) * n]};
        };
        return {vertex(0), vertex(1), vertex(2)};
    }
    static BVHIO_INLINE uint32_t primitive(const float* block, uint32_t i) {
        uint32_t biased;
        std::memcpy(&biased, block + i, sizeof biased);
        return biased - kIndexBias;
    }

  private:
    static constexpr float kErrorPerUnit = 25 * 0x1p-24f;
    static constexpr float kRoundUp = 1 + 0x1p-20f;  // covers the rounding of the bounds themselves
    // Above this size products of four coordinates overflow, so such triangles always go to the test in
    // double.
    static constexpr float kLargest = 1e18f;
    // Covers underflow: its square is well above the smallest floats.
    static constexpr float kSmallestError = 0x1p-70f;

    static BVHIO_INLINE float largestComponent(Vec3 v) {
        const float x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
        const float xy = x > y ? x : y;
        return xy > z ? xy : z;
    }
    static BVHIO_INLINE float errorBound(float size) {
        return size < kLargest ? size * kErrorPerUnit * kRoundUp + kSmallestError
                               : std::numeric_limits<float>::infinity();
    }
    void fill(const Scene& scene, std::span<const uint32_t> primitives, const PrimitiveRange& leaf);

    Vec3 center_;
    Buffer<float> data_;
};

}  // namespace bvhio
