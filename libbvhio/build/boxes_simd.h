// Boxes in SIMD registers, and the boxes of triangles. Included once for each SIMD target.
#if defined(BVHIO_BUILD_BOXES_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_BUILD_BOXES_SIMD_H
#undef BVHIO_BUILD_BOXES_SIMD_H
#else
#define BVHIO_BUILD_BOXES_SIMD_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <limits>

#include "build/reference.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourU = hn::FixedTag<uint32_t, 4>;
using FourV = hn::Vec<Four>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A Box in registers.
#if HWY_MAX_BYTES >= 32
struct BoxV {
    using Eight = hn::FixedTag<float, 8>;
    hn::Vec<Eight> lanes;

    static HWY_INLINE BoxV of(FourV low, FourV high) { return {hn::Combine(Eight(), high, low)}; }
    static HWY_INLINE BoxV load(const float* p) { return {hn::Load(Eight(), p)}; }
    static HWY_INLINE BoxV empty() { return {hn::Set(Eight(), -kInfinity)}; }
    HWY_INLINE void store(float* p) const { hn::Store(lanes, Eight(), p); }
    HWY_INLINE FourV low() const { return hn::LowerHalf(Four(), lanes); }
    HWY_INLINE FourV high() const { return hn::UpperHalf(Four(), lanes); }
    friend HWY_INLINE BoxV unite(BoxV a, BoxV b) { return {hn::Max(a.lanes, b.lanes)}; }
    friend HWY_INLINE BoxV intersect(BoxV a, BoxV b) { return {hn::Min(a.lanes, b.lanes)}; }
    /// Of boxes that are points, as vectors: their sums and multiples.
    friend HWY_INLINE BoxV operator+(BoxV a, BoxV b) { return {hn::Add(a.lanes, b.lanes)}; }
    friend HWY_INLINE BoxV operator*(BoxV a, float factor) {
        return {hn::Mul(a.lanes, hn::Set(Eight(), factor))};
    }
};
#else
struct BoxV {
    FourV lows, highs;

    static HWY_INLINE BoxV of(FourV low, FourV high) { return {low, high}; }
    static HWY_INLINE BoxV load(const float* p) { return {hn::Load(Four(), p), hn::Load(Four(), p + 4)}; }
    static HWY_INLINE BoxV empty() { return {hn::Set(Four(), -kInfinity), hn::Set(Four(), -kInfinity)}; }
    HWY_INLINE void store(float* p) const {
        hn::Store(lows, Four(), p);
        hn::Store(highs, Four(), p + 4);
    }
    HWY_INLINE FourV low() const { return lows; }
    HWY_INLINE FourV high() const { return highs; }
    friend HWY_INLINE BoxV unite(BoxV a, BoxV b) {
        return {hn::Max(a.lows, b.lows), hn::Max(a.highs, b.highs)};
    }
    friend HWY_INLINE BoxV intersect(BoxV a, BoxV b) {
        return {hn::Min(a.lows, b.lows), hn::Min(a.highs, b.highs)};
    }
    /// Of boxes that are points, as vectors: their sums and multiples.
    friend HWY_INLINE BoxV operator+(BoxV a, BoxV b) {
        return {hn::Add(a.lows, b.lows), hn::Add(a.highs, b.highs)};
    }
    friend HWY_INLINE BoxV operator*(BoxV a, float factor) {
        const FourV factors = hn::Set(Four(), factor);
        return {hn::Mul(a.lows, factors), hn::Mul(a.highs, factors)};
    }
};
#endif

/// Returns a mask for the first three lanes. The fourth lane of a reference holds an integer, which as a
/// float is denormal and slow to compute with.
HWY_INLINE FourV firstThree() {
    alignas(16) static constexpr uint32_t kThree[4] = {~0u, ~0u, ~0u, 0};
    return hn::BitCast(Four(), hn::Load(FourU(), kThree));
}

/// Loads a vertex. The fourth lane gets the x of the next vertex, or 0 after the array's last vertex.
HWY_INLINE FourV loadVertex(const Vec3* vertices, uint32_t last, uint32_t index) {
    const Four d;
    const Vec3& v = vertices[index];
    if (HWY_LIKELY(index != last)) return hn::LoadU(d, &v.x);
    alignas(16) const float lanes[4] = {v.x, v.y, v.z, 0};
    return hn::Load(d, lanes);
}

/// Computes the scaled boxes of a scene's triangles. Unused lanes are zero.
class TriangleBoxes {
  public:
    TriangleBoxes(const Scene& scene, float scale)
        : vertices_(scene.vertices.data()),
          lastVertex_(uint32_t(scene.vertices.size() - 1)),
          scale_(hn::Set(Four(), scale)) {}

    HWY_INLINE BoxV operator()(const TriangleIndices& t) const {
        const Four d;
        const FourV three = firstThree();
        const FourV v0 = load(t.v0), v1 = load(t.v1), v2 = load(t.v2);
        // 0 - min, not -min: a -0 would make unions depend on their order.
        const FourV low = hn::Sub(hn::Zero(d), hn::Mul(hn::Min(hn::Min(v0, v1), v2), scale_));
        const FourV high = hn::Mul(hn::Max(hn::Max(v0, v1), v2), scale_);
        return BoxV::of(hn::And(low, three), hn::And(high, three));
    }

    /// Prefetches the vertices of `t`.
    HWY_INLINE void prefetch(const TriangleIndices& t) const {
        for (const uint32_t index : {t.v0, t.v1, t.v2}) hwy::Prefetch(&vertices_[index]);
    }

  private:
    HWY_INLINE FourV load(uint32_t index) const { return loadVertex(vertices_, lastVertex_, index); }

    const Vec3* vertices_;
    uint32_t lastVertex_;
    FourV scale_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#endif
