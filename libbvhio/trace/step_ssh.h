// Steps rays through the ssh form. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_SSH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_SSH_H
#undef BVHIO_TRACE_STEP_SSH_H
#else
#define BVHIO_TRACE_STEP_SSH_H
#endif

#include "compress/ssh_form.h"
#include "trace/stepper.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A ray, with the numbers that each side's planes need.
struct SshRay {
    const PreparedRay& ray;
    float origin[8], reciprocal[8];
    uint32_t nearMask[8];  // all ones if the ray enters through that side

    explicit SshRay(const PreparedRay& prepared) : ray(prepared) {
        for (uint32_t side = 0; side < 6; ++side) {
            const uint32_t axis = side % 3;
            const bool isNear = ray.nearPlane[axis] == side;
            origin[side] = component(ray.origin, int(axis));
            reciprocal[side] = component(isNear ? ray.nearReciprocal : ray.farReciprocal, int(axis));
            nearMask[side] = isNear ? ~0u : 0;
        }
    }
};

template <>
class Stepper<SshForm> {
  public:
    using Ray = SshRay;
    static constexpr int kMaxPushed = 1;
    /// The cost per box: one difference and one product; one minimum or maximum, and one comparison.
    static constexpr BoxTestCost kBoxTestCost{2, 2};

    struct Cursor {
        uint32_t word;  // of the node
        float exit;     // the parameter where the ray leaves the node's box
    };

    explicit Stepper(const SshForm& form) : form_(form), nodes_(form.nodes().data()) {}

    SshRay prepare(const PreparedRay& ray) const { return SshRay(ray); }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const SshRay& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        metrics.recordFetched(0, sizeof(SshNode));
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval part = clipToBox(ray.ray, form_.bounds(), tLimit);
        root = {{nodes_[0].word, part.exit}, part.enter};
        return !part.isEmpty();
    }

    /// Each plane on the way down is clipped by the arithmetic of clipToPlanes. So the interval is the one
    /// that clipToPlanes finds for the box of all these planes.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const SshRay& ray, float tLimit, Entered<Cursor>& next,
                         Entered<Cursor>*& top, Metrics& metrics) const {
        const SshNode node{0, from.cursor.word};
        const uint32_t left = node.left();
        metrics.recordFetched(left * sizeof(SshNode), 2 * sizeof(SshNode));
        metrics.boxesTested(2, kBoxTestCost);
        const SshNode* pair = nodes_ + left;
        const float exit = from.cursor.exit < tLimit ? from.cursor.exit : tLimit;
        // The direction along the axis that separates the children gives the nearer child.
        const uint32_t nearSide = ray.nearMask[node.splitAxis()] + 1;  // 0 if the ray goes up the axis
        Entered<Cursor> nearer, farther;
        const bool entersNearer = clip(ray, pair[nearSide], from.enter, exit, nearer);
        const bool entersFarther = clip(ray, pair[nearSide ^ 1], from.enter, exit, farther);
        if (entersNearer) {
            next = nearer;
            if (entersFarther) {
                *top++ = farther;
                metrics.pushed(sizeof(farther));
            }
            return true;
        }
        next = farther;
        return entersFarther;
    }

    HWY_INLINE bool isLeaf(const Cursor& cursor) const { return SshNode{0, cursor.word}.isLeaf(); }
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor) const {
        const SshNode node{0, cursor.word};
        return {node.firstPrimitive(), node.primitiveCount()};
    }

  private:
    static HWY_INLINE bool clip(const SshRay& ray, const SshNode& node, float enter, float exit,
                                Entered<Cursor>& child) {
        const uint32_t side = node.side();
#if defined(__SSE__)
        // As in clipToPlanes, but without a branch: whether the ray enters through the plane cannot be
        // predicted.
        const __m128 t = _mm_mul_ss(_mm_sub_ss(_mm_load_ss(&node.plane), _mm_load_ss(ray.origin + side)),
                                    _mm_load_ss(ray.reciprocal + side));
        const __m128 isNear = _mm_load_ss(reinterpret_cast<const float*>(ray.nearMask + side));
        const __m128 in = _mm_set_ss(enter), out = _mm_set_ss(exit);
        const __m128 nearT = _mm_or_ps(_mm_and_ps(isNear, t), _mm_andnot_ps(isNear, in));
        const __m128 farT = _mm_or_ps(_mm_and_ps(isNear, out), _mm_andnot_ps(isNear, t));
        const __m128 entry = _mm_max_ss(nearT, in), leaving = _mm_min_ss(farT, out);
        child = {{node.word, _mm_cvtss_f32(leaving)}, _mm_cvtss_f32(entry)};
        return _mm_comile_ss(entry, leaving);
#else
        const float t = (node.plane - ray.origin[side]) * ray.reciprocal[side];
        // A NaN fails the comparisons and leaves the interval as it is, as in clipToPlanes.
        if (ray.nearMask[side] != 0)
            enter = t > enter ? t : enter;
        else
            exit = t < exit ? t : exit;
        child = {{node.word, exit}, enter};
        return enter <= exit;
#endif
    }

    const SshForm& form_;
    const SshNode* nodes_;
};
static_assert(SteppableTree<Stepper<SshForm>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
