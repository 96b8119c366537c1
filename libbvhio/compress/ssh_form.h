// The ssh form: the Single Slab Hierarchy of M. Eisemann, C. Woizischke and M. Magnor, "Ray Tracing with the
// Single-Slab Hierarchy", VMV 2008. A node holds one plane: the one side of its box that, moved inwards,
// shrinks the box it inherits from its parent most. 8 bytes.
//
// Departures: both children's planes are tested before the push (the paper tests a node's own plane after it
// is popped), siblings are adjacent, and leaves say how many triangles they have, where the paper pads all to
// one size.
#pragma once

#include "compress/form_concept.h"
#include "compress/two_levels.h"
#include "core/buffer.h"

namespace bvhio {

/// 8 bytes, plain data, stored as is in files (format-spec/ssh.md).
struct SshNode {
    float plane;
    uint32_t word;

    static constexpr uint32_t kLeaf = 3;
    static constexpr uint32_t kMaxLeafSize = 4;
    static constexpr uint32_t kMaxReferences = 1u << 25;

    /// Which of {min.x, min.y, min.z, max.x, max.y, max.z} the plane is.
    constexpr uint32_t side() const { return word & 7; }
    constexpr bool isLeaf() const { return splitAxis() == kLeaf; }
    /// Of an inner node: the axis along which its left child lies below the right one; 3 for a leaf.
    constexpr uint32_t splitAxis() const { return word >> 3 & 3; }
    /// Of an inner node: its left child; the right one is next.
    constexpr uint32_t left() const { return word >> 5 << 1; }
    constexpr uint32_t firstPrimitive() const { return word >> 5 & (kMaxReferences - 1); }
    constexpr uint32_t primitiveCount() const { return (word >> 30) + 1; }

    static constexpr SshNode inner(float plane, uint32_t side, uint32_t splitAxis, uint32_t left) {
        return {plane, side | splitAxis << 3 | left >> 1 << 5};
    }
    static constexpr SshNode leaf(float plane, uint32_t side, uint32_t first, uint32_t count) {
        return {plane, side | kLeaf << 3 | first << 5 | (count - 1) << 30};
    }
};
static_assert(sizeof(SshNode) == 8);

/// A ray with what its planes need, by side.
struct SshRay {
    const PreparedRay& ray;
    float origin[8], reciprocal[8];
    uint32_t nearMask[8];  // all ones where the ray enters through that side

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

class SshForm {
  public:
    static constexpr std::string_view kName = "ssh";
    static constexpr std::string_view kSummary = "8-byte nodes of one plane each (Single Slab Hierarchy)";
    static constexpr int kMaxChildren = 2;
    /// Per box: one difference and one product; one minimum or maximum, one comparison.
    static constexpr BoxTestCost kBoxTestCost{2, 2};

    struct Cursor {
        uint32_t word;  // of the node
        float exit;     // where the ray leaves the node's box
    };

    /// `nodes` as in format-spec/ssh.md; slot 1 is unused.
    SshForm(const Aabb& bounds, SharedArray<SshNode> nodes, SharedArray<uint32_t> primitives)
        : bounds_(bounds), nodes_(std::move(nodes)), primitives_(std::move(primitives)) {}

    /// O(n). Leaves of more than 4 triangles are halved. Throws Error{unsupported} above 2^25 references.
    static SshForm encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options);

    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    const SharedArray<SshNode>& nodes() const { return nodes_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    EncodeOptions options() const { return {}; }
    size_t nodeBytes() const { return nodes_.size() * sizeof(SshNode); }

    /// Many trees: their nodes below the roots, and the words of the roots, whose boxes are elsewhere.
    struct Trees {
        SharedArray<uint32_t> roots;
        SharedArray<SshNode> nodes;
    };
    /// As `encode` does. `boxes` are the roots', which keep them.
    static Trees encodeTrees(const Forest& forest, std::span<const Aabb> boxes, size_t references);
    static Forest decodeTrees(const Trees& trees, std::span<const Aabb> boxes);

    using Ray = SshRay;
    SshRay prepare(const PreparedRay& ray) const { return SshRay(ray); }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const SshRay& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        metrics.recordFetched(0, sizeof(SshNode));
        metrics.boxesTested(1, BoxTestCost{12, 12});
        const RayInterval part = clipToBox(ray.ray, bounds_, tLimit);
        root = {{nodes_[0].word, part.exit}, part.enter};
        return !part.isEmpty();
    }

    /// Every plane met on the way down is clipped by the arithmetic of clipToPlanes, so the interval is what
    /// that finds for the box that all of them bound.
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const SshRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        const SshNode node{0, from.cursor.word};
        const uint32_t left = node.left();
        metrics.recordFetched(left * sizeof(SshNode), 2 * sizeof(SshNode));
        metrics.boxesTested(2, kBoxTestCost);
        const SshNode* pair = nodes_.data() + left;
        const float exit = from.cursor.exit < tLimit ? from.cursor.exit : tLimit;
        // The nearer child by the direction along the axis that separates them.
        const uint32_t nearSide = ray.nearMask[node.splitAxis()] + 1;  // 0 when the ray goes up the axis
        Entered<Cursor> nearer, farther;
        const bool entersNearer = clip(ray, pair[nearSide], from.enter, exit, nearer);
        const bool entersFarther = clip(ray, pair[nearSide ^ 1], from.enter, exit, farther);
        if (entersNearer) {
            children[0] = nearer;
            if (!entersFarther) return 1;
            children[1] = farther;
            return 2;
        }
        children[0] = farther;
        return entersFarther;
    }

    bool isLeaf(const Cursor& cursor) const { return SshNode{0, cursor.word}.isLeaf(); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const {
        const SshNode node{0, cursor.word};
        return {node.firstPrimitive(), node.primitiveCount()};
    }

  private:
    static BVHIO_INLINE bool clip(const SshRay& ray, const SshNode& node, float enter, float exit,
                                  Entered<Cursor>& child) {
        const uint32_t side = node.side();
#if defined(__SSE__)
        // As in clipToPlanes; whether the plane is where the ray enters is anyone's guess, so no branch.
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

    Aabb bounds_;
    SharedArray<SshNode> nodes_;
    SharedArray<uint32_t> primitives_;
};
static_assert(Form<SshForm>);

}  // namespace bvhio
