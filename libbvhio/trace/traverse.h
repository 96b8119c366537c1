// The traversal loop: one for every form, source of triangles, query and metrics policy.
//
// It is compiled several times, once for each kind of processor (Highway's per-target inclusion, see
// trace/trace_form_simd.h). So it lives in Highway's namespace for the target and has an include guard that
// toggles, and so do all headers that it is made of.
//
// A source tests the triangles of a leaf: `source.test(range, ray, query)` offers hits to the query and
// returns true when the query is done. IndexedTriangles reads them from the scene, and needs no preparation;
// trace/triangle_blocks_simd.h has a faster one. A query (trace/queries.h) says how far the ray still
// reaches.
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

/// Triangles straight from the scene.
struct IndexedTriangles {
    const Scene& scene;
    std::span<const uint32_t> primitives;

    /// The same triangles, for another ray.
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

/// Goes on from `current`, a node that a ray entered, to the nearest leaf below it, which then is `current`.
/// Returns false where a node is met of which no child is entered.
template <SteppableNodes S, class Metrics>
HWY_INLINE bool descend(const S& stepper, const typename S::Ray& ray, float tLimit,
                        Entered<typename S::Cursor>& current, Entered<typename S::Cursor>*& top,
                        Metrics& metrics) {
    while (!stepper.isLeaf(current.cursor)) {
        Entered<typename S::Cursor> next;
        if (!stepper.step(current, ray, tLimit, next, top, metrics)) return false;
        current = next;
    }
    return true;
}

/// Walks a ray on from a node that it entered, down to the leaves: `visitLeaf(entered)` is called for each
/// and returns true when the query is done, as this does then. Nearer children come first; the others wait on
/// the stack and are dropped when a hit nearer than their boxes was found meanwhile.
template <SteppableNodes S, class Query, class Metrics, class VisitLeaf>
HWY_INLINE bool traverseFrom(const S& stepper, Entered<typename S::Cursor> current,
                             const typename S::Ray& ray, Query& query, Metrics& metrics,
                             const VisitLeaf& visitLeaf) {
    using Entry = Entered<typename S::Cursor>;
    Entry stack[kMaxDepth * S::kMaxPushed + 1];
    Entry* top = stack;
    for (;;) {
        if (descend(stepper, ray, query.boxLimit(), current, top, metrics) && visitLeaf(current)) return true;
        do {
            if (top == stack) return false;
            current = *--top;
            metrics.popped(sizeof(Entry));
        } while (!(current.enter <= query.boxLimit()));
    }
}

/// Visits leaves of triangles.
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
