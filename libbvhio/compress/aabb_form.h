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
    };

    explicit AabbForm(Bvh bvh) : bvh_(std::move(bvh)) {}
    static AabbForm encode(const Scene&, const Bvh& bvh, const EncodeOptions&) { return AabbForm(bvh); }

    Bvh decode() const { return bvh_; }
    const Bvh& bvh() const { return bvh_; }
    std::span<const uint32_t> primitives() const { return bvh_.primitives; }
    EncodeOptions options() const { return {}; }
    size_t nodeBytes() const { return bvh_.nodes.size() * sizeof(Node); }

    using Ray = const PreparedRay&;

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

    /// The record is the pair of siblings: one cache line.
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const PreparedRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        const Cursor cursor = from.cursor;
        metrics.recordFetched(cursor.first * sizeof(Node), 2 * sizeof(Node));
        metrics.boxesTested(2, kBoxTestCost);
        const Node* pair = bvh_.nodes.data() + cursor.first;
        const RayInterval left = clipToBox(ray, pair[0].bounds, tLimit);
        const RayInterval right = clipToBox(ray, pair[1].bounds, tLimit);
        if (left.isEmpty()) {
            if (right.isEmpty()) return 0;
            enter(pair[1], right.enter, children[0]);
            return 1;
        }
        if (right.isEmpty()) {
            enter(pair[0], left.enter, children[0]);
            return 1;
        }
        if (right.enter < left.enter) {
            enter(pair[1], right.enter, children[0]);
            enter(pair[0], left.enter, children[1]);
        } else {
            enter(pair[0], left.enter, children[0]);
            enter(pair[1], right.enter, children[1]);
        }
        return 2;
    }

    bool isLeaf(Cursor cursor) const { return cursor.primitiveCount != 0; }
    PrimitiveRange primitiveRange(Cursor cursor) const { return {cursor.first, cursor.primitiveCount}; }

  private:
    static BVHIO_INLINE void enter(const Node& node, float at, Entered<Cursor>& child) {
        child.cursor.first = node.first;
        child.cursor.primitiveCount = node.primitiveCount;
        child.enter = at;
    }

    Bvh bvh_;
};
static_assert(Form<AabbForm>);

}  // namespace bvhio
