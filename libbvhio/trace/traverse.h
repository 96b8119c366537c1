// The traversal loop. There is one loop for all forms, sources of triangles, queries and metrics policies.
//
// It is compiled several times, once for each kind of processor (Highway's per-target inclusion, see
// trace/trace_form_simd.h). So it is in Highway's namespace for the target and has an include guard that
// toggles, like all headers that it uses.
//
// A source tests the triangles of a leaf: `source.test(range, ray, query)` offers hits to the query and
// returns whether the query is done. IndexedTriangles reads triangles from the scene, and needs no
// preparation. trace/triangle_blocks_simd.h has a faster source. A query (trace/queries.h) knows how far the
// ray still reaches.
#if defined(BVHIO_TRACE_TRAVERSE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_TRAVERSE_H
#undef BVHIO_TRACE_TRAVERSE_H
#else
#define BVHIO_TRACE_TRAVERSE_H
#endif

#include <hwy/highway.h>

#include "scene/scene.h"
#include "trace/queries.h"
#include "trace/stepper.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// The triangles of the scene itself.
struct IndexedTriangles {
    const Scene& scene;
    std::span<const uint32_t> primitives;

    /// Returns the same triangles for another ray.
    HWY_INLINE IndexedTriangles of(const PreparedRay&) const { return *this; }

    template <class Query>
    BVHIO_INLINE bool test(PrimitiveRange range, const PreparedRay& ray, Query& query) const {
        for (uint32_t i = range.first; i < range.first + range.count; ++i) {
            Hit hit;
            hit.primitive = primitives[i];
            if (hitTriangle(ray, scene.triangle(hit.primitive), query.tLimit(), hit) && query.offer(hit))
                return true;
        }
        return false;
    }
};

/// Steps from `current`, a node that a ray entered, to the nearest leaf below it, and sets `current` to this
/// leaf. Returns false if it reaches a node of which no child is entered.
template <SteppableNodes S, class Metrics>
HWY_INLINE bool descend(const S& stepper, const typename S::Ray& ray, float tLimit,
                        Entered<typename S::Cursor>& current, Entered<typename S::Cursor>*& top,
                        Metrics& metrics) {
    while (!stepper.isLeaf(current.cursor))
        if (!stepper.step(current, ray, tLimit, current, top, metrics)) return false;
    return true;
}

/// Walks a ray from a node that it entered down to the leaves, and calls `visitLeaf(entered)` for each leaf,
/// which returns whether the query is done. Returns true as soon as it is. Nearer children come first. The
/// others wait on the stack, and are dropped if a hit nearer than their boxes was found meanwhile.
template <SteppableNodes S, class Query, class Metrics, class VisitLeaf>
HWY_INLINE bool traverseFrom(const S& stepper, Entered<typename S::Cursor> current,
                             const typename S::Ray& ray, Query& query, Metrics& metrics,
                             const VisitLeaf& visitLeaf) {
    using Entry = Entered<typename S::Cursor>;
    Entry stack[kMaxDepth * S::kMaxPushed + 1];
    Entry* top = stack;
    for (;;) {
        if (descend(stepper, ray, query.boxLimit(), current, top, metrics)) {
            // A copy: what visitors refer to is in memory, and `current` is better kept in registers.
            const Entry leaf = current;
            if (visitLeaf(leaf)) return true;
        }
        do {
            if (top == stack) return false;
            current = *--top;
            metrics.popped(sizeof(Entry));
        } while (!(current.enter <= query.boxLimit()));
    }
}

/// Visits leaves by testing their triangles.
template <class S, class Source, class Query, class Metrics>
struct TestTriangles {
    const S& stepper;
    const Source& source;
    const PreparedRay& ray;
    Query& query;
    Metrics& metrics;

    HWY_INLINE bool operator()(const Entered<typename S::Cursor>& leaf) const {
        PrimitiveRange range;
        if constexpr (requires { stepper.primitiveRange(leaf.cursor, metrics); })
            range = stepper.primitiveRange(leaf.cursor, metrics);
        else
            range = stepper.primitiveRange(leaf.cursor);
        metrics.leafEntered(range);
        return source.test(range, ray, query);
    }
};

/// Walks one ray, which must not miss by definition, through a tree.
template <SteppableTree S, class Source, class Query, class Metrics>
HWY_INLINE void traverse(const S& stepper, const Source& source, const PreparedRay& ray, Query& query,
                         Metrics& metrics) {
    const typename S::Ray stepperRay = stepper.prepare(ray);
    Entered<typename S::Cursor> root;
    if (stepper.enterRoot(stepperRay, query.boxLimit(), root, metrics))
        traverseFrom(stepper, root, stepperRay, query, metrics,
                     TestTriangles<S, Source, Query, Metrics>{stepper, source, ray, query, metrics});
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
