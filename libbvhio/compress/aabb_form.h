// The aabb form: the canonical tree itself, 32-byte nodes with full-precision boxes.
#pragma once

#include "compress/form_concept.h"

namespace bvhio {

class AabbForm {
  public:
    static constexpr std::string_view kName = "aabb";
    static constexpr std::string_view kSummary = "32-byte nodes with full-precision boxes";
    static constexpr int kMaxChildren = 2;
    /// Per box: 6 differences and 6 products; 6 minima and maxima, 4 to merge the axes, 2 comparisons.
    static constexpr BoxTestCost kBoxTestCost{12, 12};

    /// What a node says of its children, copied: the node itself need not be fetched again.
    struct Cursor {
        uint32_t first, primitiveCount;

        BVHIO_INLINE void set(const Node& node, uint32_t) {
            first = node.first;
            primitiveCount = node.primitiveCount;
        }
    };

    explicit AabbForm(Bvh bvh) : bvh_(std::move(bvh)) {}
    static AabbForm encode(const Scene&, const Bvh& bvh, const EncodeOptions&) { return AabbForm(bvh); }

    Bvh decode() const { return bvh_; }
    const Bvh& bvh() const { return bvh_; }
    std::span<const uint32_t> primitives() const { return bvh_.primitives; }
    EncodeOptions options() const { return {}; }
    size_t nodeBytes() const { return bvh_.nodes.size() * sizeof(Node); }

    using Ray = const PreparedRay&;
    const PreparedRay& prepare(const PreparedRay& ray) const { return ray; }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const PreparedRay& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        metrics.recordFetched(0, sizeof(Node));
        metrics.boxesTested(1, kBoxTestCost);
        const Node& node = bvh_.nodes[0];
        const RayInterval part = clipToBox(ray, node.bounds, tLimit);
        root = {{node.first, node.primitiveCount}, part.enter};
        return !part.isEmpty();
    }

    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const PreparedRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return stepToPair(from.cursor.first, ray, tLimit, children, metrics);
    }

    /// To the siblings from index `pair` on. The record is both: one cache line. C is a cursor of any kind,
    /// set from a node and its index.
    template <class C, class Metrics>
    BVHIO_INLINE int stepToPair(uint32_t pair, const PreparedRay& ray, float tLimit, Entered<C>* children,
                                Metrics& metrics) const {
        metrics.recordFetched(pair * sizeof(Node), 2 * sizeof(Node));
        metrics.boxesTested(2, kBoxTestCost);
        const Node& left = bvh_.nodes[pair];
        const Node& right = bvh_.nodes[pair + 1];
        const RayInterval inLeft = clipToBox(ray, left.bounds, tLimit);
        const RayInterval inRight = clipToBox(ray, right.bounds, tLimit);
        if (inLeft.isEmpty()) {
            if (inRight.isEmpty()) return 0;
            enter(children[0], pair + 1, inRight.enter);
            return 1;
        }
        if (inRight.isEmpty()) {
            enter(children[0], pair, inLeft.enter);
            return 1;
        }
        if (inRight.enter < inLeft.enter) {
            enter(children[0], pair + 1, inRight.enter);
            enter(children[1], pair, inLeft.enter);
        } else {
            enter(children[0], pair, inLeft.enter);
            enter(children[1], pair + 1, inRight.enter);
        }
        return 2;
    }

    bool isLeaf(Cursor cursor) const { return cursor.primitiveCount != 0; }
    PrimitiveRange primitiveRange(Cursor cursor) const { return {cursor.first, cursor.primitiveCount}; }

  private:
    template <class C>
    BVHIO_INLINE void enter(Entered<C>& child, uint32_t index, float at) const {
        child.cursor.set(bvh_.nodes[index], index);
        child.enter = at;
    }

    Bvh bvh_;
};
static_assert(Form<AabbForm>);

}  // namespace bvhio
