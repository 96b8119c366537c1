// The traversal loop: one for every form, source of triangles, query and metrics policy.
//
// It is compiled several times, once for each kind of processor (Highway's per-target inclusion, see
// trace/trace_blocks_simd.h), so it lives in Highway's namespace for the target and has an include guard that
// toggles.
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

#include "compress/form_concept.h"
#include "scene/scene.h"
#include "trace/queries.h"

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

/// Walks a ray on from a node that it entered, down to the leaves: `visitLeaf(entered)` is called for each
/// and returns true when the query is done, as this does then. Nearer children come first; the others wait on
/// the stack and are dropped when a hit nearer than their boxes was found meanwhile.
template <SteppableForm F, class Query, class Metrics, class VisitLeaf>
HWY_INLINE bool traverseFrom(const F& form, Entered<typename F::Cursor> current,
                             const typename F::Ray& formRay, Query& query, Metrics& metrics,
                             const VisitLeaf& visitLeaf) {
    using Entry = Entered<typename F::Cursor>;
    Entry stack[kMaxDepth * (F::kMaxChildren - 1) + 1];
    Entry* top = stack;
    for (;;) {
        int entered = 0;
        if (form.isLeaf(current.cursor)) {
            if (visitLeaf(current)) return true;
        } else {
            Entry children[F::kMaxChildren];
            entered = form.step(current, formRay, query.boxLimit(), children, metrics);
            for (int i = entered - 1; i > 0; --i) {
                *top++ = children[i];
                metrics.pushed(sizeof(Entry));
            }
            if (entered > 0) current = children[0];
        }
        if (entered == 0) {
            do {
                if (top == stack) return false;
                current = *--top;
                metrics.popped(sizeof(Entry));
            } while (!(current.enter <= query.boxLimit()));
        }
    }
}

/// Visits leaves of triangles.
template <class F, class Source, class Query, class Metrics>
struct TestTriangles {
    const F& form;
    const Source& source;
    const PreparedRay& ray;
    Query& query;
    Metrics& metrics;

    HWY_INLINE bool operator()(const Entered<typename F::Cursor>& leaf) const {
        PrimitiveRange range;
        if constexpr (requires { form.primitiveRange(leaf.cursor, metrics); })
            range = form.primitiveRange(leaf.cursor, metrics);
        else
            range = form.primitiveRange(leaf.cursor);
        metrics.leafEntered(range);
        return source.test(range, ray, query);
    }
};

/// Walks one ray, which must not miss by definition, through the form.
template <SteppableForm F, class Source, class Query, class Metrics>
HWY_INLINE void traverse(const F& form, const Source& source, const PreparedRay& ray, Query& query,
                         Metrics& metrics) {
    const typename F::Ray formRay = form.prepare(ray);
    Entered<typename F::Cursor> root;
    if (form.enterRoot(formRay, query.boxLimit(), root, metrics))
        traverseFrom(form, root, formRay, query, metrics,
                     TestTriangles<F, Source, Query, Metrics>{form, source, ray, query, metrics});
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
