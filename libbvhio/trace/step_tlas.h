// Steps rays through the top level of the two-level form. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_TLAS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_TLAS_H
#undef BVHIO_TRACE_STEP_TLAS_H
#else
#define BVHIO_TRACE_STEP_TLAS_H
#endif

#include "compress/tlas.h"
#include "trace/step_aabb.h"
#include "trace/step_blases.h"
#include "trace/step_quantized.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A stepper with a function `entry`, which returns how the ray enters a leaf's box, the box of a BLAS's
/// root.
template <class Tlas>
class TlasStepper;

/// A cursor that also has the node's index, since BLASes need the node's box.
struct AabbTlasCursor {
    uint32_t first, primitiveCount, node;

    HWY_INLINE void set(const Node& from, uint32_t index) {
        first = from.first;
        primitiveCount = from.primitiveCount;
        node = index;
    }
};

template <>
class TlasStepper<AabbTlas> : public AabbPairs<AabbTlasCursor> {
  public:
    explicit TlasStepper(const AabbTlas& tlas) : AabbPairs(tlas.form()) {}

    HWY_INLINE RootEntry entry(const Entered<Cursor>& leaf, const PreparedRay& ray, float tLimit) const {
        return {ray, nodes_[leaf.cursor.node].bounds, leaf.enter, tLimit};
    }
};

template <>
class TlasStepper<QuantizedTlas> : public Stepper<QuantizedForm> {
  public:
    explicit TlasStepper(const QuantizedTlas& tlas) : Stepper(tlas.form()) {}

    HWY_INLINE RootEntry entry(const Entered<Cursor>& leaf, const RayFrame& ray, float tLimit) const {
        return {ray, leaf.cursor.box, leaf.enter, tLimit};
    }
};
static_assert(SteppableTree<TlasStepper<AabbTlas>> && SteppableTree<TlasStepper<QuantizedTlas>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
