// Steps rays through nodes that are stored in other ways. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_NODE_STORAGE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_NODE_STORAGE_H
#undef BVHIO_TRACE_STEP_NODE_STORAGE_H
#else
#define BVHIO_TRACE_STEP_NODE_STORAGE_H
#endif

#include "trace/node_storage.h"
#include "trace/step_aabb.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

template <class Arrays>
class Stepper<NodesIn<Arrays>> {
  public:
    static constexpr int kMaxPushed = 1;
    using Cursor = uint32_t;  // a reference
    using Ray = typename Arrays::Ray;

    explicit Stepper(const NodesIn<Arrays>& nodes) : nodes_(nodes), arrays_(nodes.arrays()) {}

    Ray prepare(const PreparedRay& ray) const { return arrays_.prepare(ray); }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const PreparedRay& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval part = clipToBox(ray, nodes_.bounds(), tLimit);
        root = {nodes_.root(), part.enter};
        return !part.isEmpty();
    }
    template <class Metrics>
    HWY_INLINE bool enterRoot(const ArraysOf16And8::Ray& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        return enterRoot(ray.given, tLimit, root, metrics);
    }

    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const std::remove_reference_t<Ray>& ray, float tLimit,
                         Entered<Cursor>& next, Entered<Cursor>*& top, Metrics& metrics) const {
        const size_t i = from.cursor;
        arrays_.recordFetches(i, metrics);
        metrics.boxesTested(2, kFullBoxTestCost);
        const RayInterval inLeft = arrays_.clip(i, 0, ray, tLimit);
        const RayInterval inRight = arrays_.clip(i, 1, ray, tLimit);
        if (inLeft.isEmpty()) {
            next = {arrays_.child(i, 1), inRight.enter};
            return !inRight.isEmpty();
        }
        if (inRight.isEmpty()) {
            next = {arrays_.child(i, 0), inLeft.enter};
            return true;
        }
        const bool rightFirst = inRight.enter < inLeft.enter;
        next = {arrays_.child(i, rightFirst), rightFirst ? inRight.enter : inLeft.enter};
        *top++ = {arrays_.child(i, !rightFirst), rightFirst ? inLeft.enter : inRight.enter};
        metrics.pushed(sizeof(next));
        return true;
    }

    HWY_INLINE bool isLeaf(Cursor cursor) const { return ChildReferences::isLeaf(cursor); }
    HWY_INLINE PrimitiveRange primitiveRange(Cursor cursor) const {
        return nodes_.references().range(cursor);
    }

  private:
    const NodesIn<Arrays>& nodes_;
    const Arrays& arrays_;
};

template <>
class Stepper<NodesInPairs> : public Stepper<AabbForm> {
  public:
    using Stepper<AabbForm>::Stepper;
};

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
