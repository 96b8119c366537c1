// Traversal of the two-level form: the one loop twice. A leaf of the top level is a root of the bottom level,
// from which the same loop goes on. The order in which nodes are met is that of one stack, since what was
// pushed earlier waits until a subtree is done. Per target, like trace/traverse.h.
#if defined(BVHIO_TRACE_TRAVERSE_TWO_LEVEL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_TRAVERSE_TWO_LEVEL_H
#undef BVHIO_TRACE_TRAVERSE_TWO_LEVEL_H
#else
#define BVHIO_TRACE_TRAVERSE_TWO_LEVEL_H
#endif

#include "compress/two_level_form.h"
#include "metrics/metrics.h"
#include "trace/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// Walks through the BLAS below a leaf of the top level that is entered.
template <class Tree, class Entry, class Source, class Query, class Metrics>
HWY_INLINE bool traverseBlas(const Tree& tree, const Entry& entry, const typename Tree::Ray& treeRay,
                             const Source& source, const PreparedRay& ray, Query& query, Metrics& metrics) {
    return traverseFrom(tree, tree.root(entry, treeRay, metrics), treeRay, query, metrics,
                        TestTriangles<Tree, Source, Query, Metrics>{tree, source, ray, query, metrics});
}

/// Visits leaves of the top level: walks through the BLAS there.
template <class Tlas, class Blases, class Source, class Query, class Metrics>
struct TraverseBlas {
    const Tlas& tlas;
    const Blases& blases;
    const Source& source;
    const PreparedRay& ray;
    const typename Tlas::Ray& tlasRay;
    const typename Blases::Ray& blasRay;
    Query& query;
    Metrics& metrics;

    HWY_INLINE bool operator()(const Entered<typename Tlas::Cursor>& leaf) const {
        return traverseBlas(blases.tree(tlas.primitiveRange(leaf.cursor)),
                            tlas.entry(leaf, tlasRay, query.boxLimit()), blasRay, source, ray, query,
                            metrics);
    }
};

template <class Tlas, class Blases, class Source, class Query, class Metrics>
HWY_INLINE void traverseBelow(const Tlas& tlas, const typename Tlas::Ray& tlasRay,
                              const Entered<typename Tlas::Cursor>& root, const Blases& blases,
                              const typename Blases::Ray& blasRay, const Source& source,
                              const PreparedRay& ray, Query& query, Metrics& metrics) {
    MetricsBehind<Metrics> behind{metrics, tlas.form().nodeBytes()};
    traverseFrom(tlas, root, tlasRay, query, metrics,
                 TraverseBlas<Tlas, Blases, Source, Query, MetricsBehind<Metrics>>{
                     tlas, blases, source, ray, tlasRay, blasRay, query, behind});
}

/// Not inlined: there is one for each pair of forms, and the choice is made once a ray.
template <class Tlas, class Blases, class Source, class Query, class Metrics>
HWY_NOINLINE void traverseLevels(const Tlas& tlas, const Blases& blases, const Source& source,
                                 const PreparedRay& ray, Query& query, Metrics& metrics) {
    const typename Tlas::Ray tlasRay = tlas.prepare(ray);
    Entered<typename Tlas::Cursor> root;
    if (!tlas.enterRoot(tlasRay, query.boxLimit(), root, metrics)) return;
    if constexpr (std::is_same_v<typename Tlas::Ray, typename Blases::Ray>)
        traverseBelow(tlas, tlasRay, root, blases, tlasRay, source, ray, query, metrics);
    else
        traverseBelow(tlas, tlasRay, root, blases, blases.prepare(ray, tlas.bounds()), source, ray, query,
                      metrics);
}

/// Walks through the BLAS of an instance with the ray in its space. The definition of a hit is in
/// scene/instance.h. Not inlined: top levels of all forms share it.
template <class Blases, class Source, class Query, class Metrics>
HWY_NOINLINE bool traverseInstance(uint32_t number, const Blases& blases, const PlacedBlases& placed,
                                   const Source& source, const PreparedRay& ray, Query& query,
                                   Metrics& metrics) {
    const InstanceEntry& entry = placed.entries[number];
    size_t offset = blases.nodeBytes();
    metrics.recordFetched(offset + number * sizeof(InstanceEntry), sizeof(InstanceEntry));
    metrics.boxesTested(1, AabbForm::kBoxTestCost);
    const RayInterval inWorld = clipToBox(ray, entry.bounds, query.boxLimit());
    if (inWorld.isEmpty()) return false;

    const PreparedRay local(objectRay(entry.toObject, ray));
    const Aabb& box = placed.meshBounds[entry.mesh];
    offset += placed.entries.size() * sizeof(InstanceEntry);
    metrics.recordFetched(offset + entry.mesh * sizeof(Aabb), sizeof(Aabb));
    metrics.boxesTested(1, AabbForm::kBoxTestCost);
    const RayInterval inMesh = clipToBox(local, box, query.boxLimit());
    if (local.missesByDefinition() || inMesh.isEmpty()) return false;

    PrimitiveRange leaf{entry.mesh, 1};
    if constexpr (Blases::kAreRuns) {
        offset += placed.meshBounds.size() * sizeof(Aabb);
        metrics.recordFetched(offset + entry.mesh * sizeof(PrimitiveRange), sizeof(PrimitiveRange));
        leaf = placed.runs[entry.mesh];
    }
    using Within = InstanceQuery<Query>;
    Within within(query, inWorld.enter, entry.primitiveOffset);
    const typename Blases::Ray blasRay = blases.prepare(local, box);
    return traverseBlas(blases.tree(leaf), BoxEntry{local, box, inMesh.enter, query.boxLimit()}, blasRay,
                        source.of(local), local, within, metrics);
}

/// Visits leaves of a top level over instances. What form meshes' trees are in is asked at each: so there is
/// one loop for each form of the top level, not one for each pair of forms.
template <class Tlas, class Source, class Query, class Metrics>
struct TraverseInstance {
    const Tlas& tlas;
    const TwoLevelForm& form;
    const Source& source;
    const PreparedRay& ray;
    Query& query;
    Metrics& metrics;

    HWY_INLINE bool operator()(const Entered<typename Tlas::Cursor>& leaf) const {
        const uint32_t number = tlas.primitiveRange(leaf.cursor).first;
        return std::visit(
            [&](const auto& blases) {
                return traverseInstance(number, blases, form.placed(), source, ray, query, metrics);
            },
            form.blases());
    }
};

template <class Tlas, class Source, class Query, class Metrics>
HWY_NOINLINE void traverseInstances(const Tlas& tlas, const TwoLevelForm& form, const Source& source,
                                    const PreparedRay& ray, Query& query, Metrics& metrics) {
    const typename Tlas::Ray tlasRay = tlas.prepare(ray);
    Entered<typename Tlas::Cursor> root;
    if (!tlas.enterRoot(tlasRay, query.boxLimit(), root, metrics)) return;
    MetricsBehind<Metrics> behind{metrics, tlas.form().nodeBytes()};
    traverseFrom(tlas, root, tlasRay, query, metrics,
                 TraverseInstance<Tlas, Source, Query, MetricsBehind<Metrics>>{tlas, form, source, ray, query,
                                                                               behind});
}

template <class Source, class Query, class Metrics>
HWY_INLINE void traverse(const TwoLevelForm& form, const Source& source, const PreparedRay& ray, Query& query,
                         Metrics& metrics) {
    if (form.isInstanced())
        return std::visit(
            [&](const auto& tlas) { traverseInstances(tlas, form, source, ray, query, metrics); },
            form.tlas());
    std::visit([&](const auto& tlas,
                   const auto& blases) { traverseLevels(tlas, blases, source, ray, query, metrics); },
               form.tlas(), form.blases());
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
