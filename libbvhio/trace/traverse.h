// The traversal loop: one for every form, source of triangles, query and metrics policy.
//
// It is compiled several times, once for each kind of processor (Highway's per-target inclusion, see
// trace/trace_blocks.cpp), so it lives in Highway's namespace for the target and has an include guard that
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

/// Walks one ray, which must not miss by definition, through the form. Nearer children come first; the others
/// wait on the stack and are dropped when a hit nearer than their boxes was found meanwhile.
template <Form F, class Source, class Query, class Metrics>
HWY_INLINE void traverse(const F& form, const Source& source, const PreparedRay& ray, Query& query,
                         Metrics& metrics) {
    using Entry = Entered<typename F::Cursor>;
    Entry stack[kMaxDepth * (F::kMaxChildren - 1) + 1];
    Entry* top = stack;

    const typename F::Ray formRay(ray);
    Entry current;
    if (!form.enterRoot(formRay, query.boxLimit(), current, metrics)) return;
    for (;;) {
        int entered = 0;
        if (form.isLeaf(current.cursor)) {
            const PrimitiveRange range = form.primitiveRange(current.cursor);
            metrics.leafEntered(range);
            if (source.test(range, ray, query)) return;
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
                if (top == stack) return;
                current = *--top;
                metrics.popped(sizeof(Entry));
            } while (!(current.enter <= query.boxLimit()));
        }
    }
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
