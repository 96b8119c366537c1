// Traversal of the two-level form, with the same loop on both levels. A leaf of the top level is a root of
// the bottom level, from which the loop continues. Nodes are visited in the same order as with one stack,
// since entries that were pushed earlier wait until a subtree is done. Compiled for each target, like
// trace/traverse.h.
//
// The loops of the levels are compiled separately and call each other. So there is a loop for each form of a
// level, and not for each pair of forms.
#if defined(BVHIO_TRACE_STEP_TWO_LEVEL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_TWO_LEVEL_H
#undef BVHIO_TRACE_STEP_TWO_LEVEL_H
#else
#define BVHIO_TRACE_STEP_TWO_LEVEL_H
#endif

#include "compress/two_level_form.h"
#include "metrics/metrics.h"
#include "trace/step_blases.h"
#include "trace/step_tlas.h"
#include "trace/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A call of `context(leaf, entry)` whose type does not depend on the context's.
class LeafVisitor {
  public:
    template <class Context>
    explicit LeafVisitor(const Context& context)
        : context_(&context),
          visit_([](const void* self, PrimitiveRange leaf, const RootEntry& entry)
                     HWY_ATTR { return (*static_cast<const Context*>(self))(leaf, entry); }) {}

    bool operator()(PrimitiveRange leaf, const RootEntry& entry) const {
        return visit_(context_, leaf, entry);
    }

  private:
    const void* context_;
    bool (*visit_)(const void* context, PrimitiveRange leaf, const RootEntry& entry);
};

/// Walks through a top level. `visit(leaf, entry)` is called for each leaf that is entered, and returns
/// whether the query is done.
template <class Tlas, class Query, class Metrics>
HWY_NOINLINE void traverseTlas(const TlasStepper<Tlas>& tlas,
                               const Entered<typename TlasStepper<Tlas>::Cursor>& root,
                               const typename TlasStepper<Tlas>::Ray& ray, Query& query, Metrics& metrics,
                               const LeafVisitor& visit) {
    const auto visitLeaf = [&](const Entered<typename TlasStepper<Tlas>::Cursor>& leaf) HWY_ATTR {
        return visit(tlas.primitiveRange(leaf.cursor), tlas.entry(leaf, ray, query.boxLimit()));
    };
    traverseFrom(tlas, root, ray, query, metrics, visitLeaf);
}

/// Walks through BLASes with a ray that is prepared for them. Returns whether the query is done. The query is
/// always an InstanceQuery, also for trees that are not instances, so that both share their loops.
template <class Blases, class Source, class Query, class Metrics>
struct TraverseBlas {
    const Blases& blases;
    const typename BlasStepper<Blases>::Ray& blasRay;
    const Source& source;
    const PreparedRay& ray;
    InstanceQuery<Query>& query;
    Metrics& metrics;

    HWY_NOINLINE bool operator()(PrimitiveRange leaf, const RootEntry& entry) const {
        using Tree = BlasStepper<Blases>;
        const Tree tree(blases, leaf);
        return traverseFrom(
            tree, tree.root(entry, blasRay, metrics), blasRay, query, metrics,
            TestTriangles<Tree, Source, InstanceQuery<Query>, Metrics>{tree, source, ray, query, metrics});
    }
};

/// Traverses a tree over the primitives of a plain scene, in two levels.
template <class Tlas, class Blases, class Source, class Query, class Metrics>
HWY_INLINE void traverseLevels(const Tlas& tlas, const Blases& blases, const Source& source,
                               const PreparedRay& ray, Query& query, Metrics& metrics) {
    using Top = TlasStepper<Tlas>;
    using BlasRay = typename BlasStepper<Blases>::Ray;
    const Top top(tlas);
    const typename Top::Ray topRay = top.prepare(ray);
    Entered<typename Top::Cursor> root;
    if (!top.enterRoot(topRay, query.boxLimit(), root, metrics)) return;
    MetricsBehind<Metrics> behind{metrics, tlas.form().nodeBytes()};
    InstanceQuery<Query> within(query, -std::numeric_limits<float>::infinity(), 0);
    const auto traverse = [&](const BlasRay& blasRay) HWY_ATTR {
        const TraverseBlas<Blases, Source, Query, MetricsBehind<Metrics>> below{blases, blasRay, source,
                                                                                ray,    within,  behind};
        traverseTlas<Tlas>(top, root, topRay, query, metrics, LeafVisitor(below));
    };
    if constexpr (std::is_same_v<typename Top::Ray, BlasRay>)
        traverse(topRay);
    else
        traverse(BlasStepper<Blases>::prepare(ray, tlas.bounds()));
}

/// Walks through the BLAS of an instance with the ray in the instance's space. Hits are defined in
/// scene/instance.h.
template <class Blases, class Source, class Query, class Metrics>
HWY_NOINLINE bool traverseInstance(uint32_t number, const Blases& blases, const PlacedBlases& placed,
                                   const Source& source, const PreparedRay& ray, Query& query,
                                   Metrics& metrics) {
    const InstanceEntry& entry = placed.entries[number];
    size_t offset = blases.nodeBytes();
    metrics.recordFetched(offset + number * sizeof(InstanceEntry), sizeof(InstanceEntry));
    metrics.boxesTested(1, kFullBoxTestCost);
    const RayInterval inWorld = clipToBox(ray, entry.bounds, query.boxLimit());
    if (inWorld.isEmpty()) return false;

    const PreparedRay local(objectRay(entry.toObject, ray));
    const Aabb& box = placed.meshBounds[entry.mesh];
    offset += placed.entries.size() * sizeof(InstanceEntry);
    metrics.recordFetched(offset + entry.mesh * sizeof(Aabb), sizeof(Aabb));
    metrics.boxesTested(1, kFullBoxTestCost);
    const RayInterval inMesh = clipToBox(local, box, query.boxLimit());
    if (local.missesByDefinition() || inMesh.isEmpty()) return false;

    PrimitiveRange leaf{entry.mesh, 1};
    if constexpr (Blases::kAreRuns) {
        offset += placed.meshBounds.size() * sizeof(Aabb);
        metrics.recordFetched(offset + entry.mesh * sizeof(PrimitiveRange), sizeof(PrimitiveRange));
        leaf = placed.runs[entry.mesh];
    }
    InstanceQuery<Query> within(query, inWorld.enter, entry.primitiveOffset);
    const typename BlasStepper<Blases>::Ray blasRay = BlasStepper<Blases>::prepare(local, box);
    const Source localSource = source.of(local);
    const TraverseBlas<Blases, Source, Query, Metrics> below{blases, blasRay, localSource,
                                                             local,  within,  metrics};
    return below(leaf, RootEntry(local, box, inMesh.enter, query.boxLimit()));
}

/// Traverses a top level over instances.
template <class Tlas, class Source, class Query, class Metrics>
HWY_INLINE void traverseInstances(const Tlas& tlas, const TwoLevelForm& form, const Source& source,
                                  const PreparedRay& ray, Query& query, Metrics& metrics) {
    using Top = TlasStepper<Tlas>;
    const Top top(tlas);
    const typename Top::Ray topRay = top.prepare(ray);
    Entered<typename Top::Cursor> root;
    if (!top.enterRoot(topRay, query.boxLimit(), root, metrics)) return;
    MetricsBehind<Metrics> behind{metrics, tlas.form().nodeBytes()};
    const auto visitLeaf = [&](PrimitiveRange leaf, const RootEntry&) HWY_ATTR {
        return std::visit(
            [&](const auto& blases) HWY_ATTR {
                return traverseInstance(leaf.first, blases, form.placed(), source, ray, query, behind);
            },
            form.blases());
    };
    traverseTlas<Tlas>(top, root, topRay, query, metrics, LeafVisitor(visitLeaf));
}

template <>
class Stepper<TwoLevelForm> {
  public:
    explicit Stepper(const TwoLevelForm& form) : form_(form) {}
    const TwoLevelForm& form() const { return form_; }

  private:
    const TwoLevelForm& form_;
};

template <class Source, class Query, class Metrics>
HWY_INLINE void traverse(const Stepper<TwoLevelForm>& stepper, const Source& source, const PreparedRay& ray,
                         Query& query, Metrics& metrics) {
    const TwoLevelForm& form = stepper.form();
    std::visit(
        [&](const auto& tlas) HWY_ATTR {
            if (form.isInstanced()) return traverseInstances(tlas, form, source, ray, query, metrics);
            std::visit([&](const auto& blases)
                           HWY_ATTR { traverseLevels(tlas, blases, source, ray, query, metrics); },
                       form.blases());
        },
        form.tlas());
}

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
