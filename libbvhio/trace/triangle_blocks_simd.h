// Tests the block of a leaf, four triangles at a time. Compiled for each target, like trace/traverse.h.
//
// The sheared edge functions of four triangles are computed in float. A lane is dropped only if two of its
// edge functions certainly have opposite signs (see TriangleBlocks). The few remaining triangles go to
// hitTriangle, which alone decides. So hits are the same, bit for bit, as without blocks.
#if defined(BVHIO_TRACE_TRIANGLE_BLOCKS_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_TRIANGLE_BLOCKS_SIMD_H
#undef BVHIO_TRACE_TRIANGLE_BLOCKS_SIMD_H
#else
#define BVHIO_TRACE_TRIANGLE_BLOCKS_SIMD_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "trace/triangle_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

// Inlined into each loop that tests triangles, but not in builds with sanitizers, whose checks make each copy
// slow to compile.
#undef BVHIO_INLINE_TEST
#ifdef BVHIO_SANITIZED
#define BVHIO_INLINE_TEST HWY_NOINLINE
#else
#define BVHIO_INLINE_TEST HWY_INLINE
#endif

/// The triangles of the blocks, for one ray.
class BlockTriangles {
    // Four lanes, or one on the most basic processors.
    using D = hwy::HWY_NAMESPACE::CappedTag<float, 4>;
    using Floats = hwy::HWY_NAMESPACE::Vec<D>;
    static constexpr int kLanes = HWY_TARGET == HWY_SCALAR ? 1 : 4;

  public:
    HWY_INLINE BlockTriangles(const TriangleBlocks& blocks, const PreparedRay& ray)
        : blocks_(blocks),
          origin_{component(ray.origin, ray.axisX), component(ray.origin, ray.axisY),
                  component(ray.origin, ray.axisZ)},
          rayError_(blocks.rayError(ray.origin)),
          shearX_(float(ray.shearX)),
          shearY_(float(ray.shearY)) {}

    /// Returns the same triangles for another ray.
    HWY_INLINE BlockTriangles of(const PreparedRay& ray) const { return {blocks_, ray}; }

    template <class Query>
    BVHIO_INLINE_TEST bool test(PrimitiveRange range, const PreparedRay& ray, Query& query) const {
        const float* const block = blocks_.block(range.first);
        for (uint32_t first = 0; first < range.count; first += 4) {
            uint32_t lanes = candidates(block + first, range.count, ray);
            if (range.count - first < 4) lanes &= (1u << (range.count - first)) - 1;
            for (; lanes != 0; lanes &= lanes - 1) {
                const uint32_t i = first + uint32_t(std::countr_zero(lanes));
                Hit hit;
                hit.primitive = TriangleBlocks::primitive(block, i);
                const Triangle triangle = TriangleBlocks::triangle(block, range.count, i);
                if (hitTriangle(ray, triangle, query.tLimit(), hit) && query.offer(hit)) return true;
            }
        }
        return false;
    }

  private:
    struct Sheared {
        Floats x, y;
    };

    /// Shears the vertices in the three rows of `stride` floats that start at `rows`.
    HWY_INLINE Sheared shear(const float* rows, size_t stride, const PreparedRay& ray) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const D d;
        const auto relative = [&](int axis, float origin) HWY_ATTR {
            return hn::Sub(hn::LoadU(d, rows + size_t(axis) * stride), hn::Set(d, origin));
        };
        const auto x = relative(ray.axisX, origin_.x), y = relative(ray.axisY, origin_.y),
                   z = relative(ray.axisZ, origin_.z);
        return {hn::Sub(x, hn::Mul(hn::Set(d, shearX_), z)), hn::Sub(y, hn::Mul(hn::Set(d, shearY_), z))};
    }

    /// Returns a bit for each of four columns, set if hitTriangle may accept it.
    HWY_INLINE uint32_t candidates(const float* columns, size_t stride, const PreparedRay& ray) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const D d;
        uint32_t dropped = 0;
        for (int lane = 0; lane < 4; lane += kLanes, columns += kLanes) {
            const float* const vertices = columns + TriangleBlocks::kVertexRows * stride;
            const auto a = shear(vertices, stride, ray);
            const auto b = shear(vertices + 3 * stride, stride, ray);
            const auto c = shear(vertices + 6 * stride, stride, ray);
            const auto weight0 = hn::Sub(hn::Mul(c.x, b.y), hn::Mul(c.y, b.x));
            const auto weight1 = hn::Sub(hn::Mul(a.x, c.y), hn::Mul(a.y, c.x));
            const auto weight2 = hn::Sub(hn::Mul(b.x, a.y), hn::Mul(b.y, a.x));
            const auto rayError = hn::Set(d, rayError_);
            const auto error =
                hn::Mul(hn::Add(hn::LoadU(d, columns + TriangleBlocks::kErrorRow * stride), rayError),
                        hn::Add(hn::LoadU(d, columns + TriangleBlocks::kReachRow * stride), rayError));
            const auto minusError = hn::Neg(error);
            // Each weight is compared by itself, instead of the minimum and the maximum: a NaN must neither
            // count nor hide the others.
            const auto positive =
                hn::Or(hn::Or(hn::Gt(weight0, error), hn::Gt(weight1, error)), hn::Gt(weight2, error));
            const auto negative = hn::Or(hn::Or(hn::Lt(weight0, minusError), hn::Lt(weight1, minusError)),
                                         hn::Lt(weight2, minusError));
            uint8_t bits[8];
            hn::StoreMaskBits(d, hn::And(positive, negative), bits);
            dropped |= uint32_t(bits[0]) << lane;
        }
        return ~dropped & 15u;
    }

    const TriangleBlocks& blocks_;
    Vec3 origin_;  // along axisX, axisY, axisZ
    float rayError_, shearX_, shearY_;
};

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
