// Steps rays through the aabb form. Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_AABB_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_AABB_H
#undef BVHIO_TRACE_STEP_AABB_H
#else
#define BVHIO_TRACE_STEP_AABB_H
#endif

#include <hwy/cache_control.h>

#include "compress/aabb_form.h"
#include "trace/stepper.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A copy of a node's data about its children, so that the node need not be fetched again.
struct AabbCursor {
    uint32_t first, primitiveCount;

    HWY_INLINE void set(const Node& node, uint32_t) {
        first = node.first;
        primitiveCount = node.primitiveCount;
    }
};

/// Steps from pair to pair of 32-byte nodes. C is any cursor that begins like AabbCursor and has a function
/// to set it from a node and its index.
template <class C>
class AabbPairs {
  public:
    using Cursor = C;
    using Ray = const PreparedRay&;
    static constexpr int kMaxPushed = 1;

    explicit AabbPairs(const AabbForm& form) : nodes_(form.bvh().nodes.data()) {}

    const PreparedRay& prepare(const PreparedRay& ray) const { return ray; }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const PreparedRay& ray, float tLimit, Entered<C>& root,
                              Metrics& metrics) const {
        metrics.recordFetched(0, sizeof(Node));
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval part = clipToBox(ray, nodes_[0].bounds, tLimit);
        enter(root, 0, part.enter);
        return !part.isEmpty();
    }

    /// Both siblings are one record, which is a cache line.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<C>& from, const PreparedRay& ray, float tLimit, Entered<C>& next,
                         Entered<C>*& top, Metrics& metrics) const {
        const uint32_t left = from.cursor.first, right = left + 1;
        metrics.recordFetched(left * sizeof(Node), 2 * sizeof(Node));
        metrics.boxesTested(2, kFullBoxTestCost);
        prefetchBelow(nodes_[left]);
        prefetchBelow(nodes_[right]);
        const RayInterval inLeft = clipToBox(ray, nodes_[left].bounds, tLimit);
        const RayInterval inRight = clipToBox(ray, nodes_[right].bounds, tLimit);
        if (inLeft.isEmpty()) {
            if (inRight.isEmpty()) return false;
            enter(next, right, inRight.enter);
            return true;
        }
        if (inRight.isEmpty()) {
            enter(next, left, inLeft.enter);
            return true;
        }
        if (inRight.enter < inLeft.enter) {
            enter(*top++, left, inLeft.enter);
            enter(next, right, inRight.enter);
        } else {
            enter(*top++, right, inRight.enter);
            enter(next, left, inLeft.enter);
        }
        metrics.pushed(sizeof(Entered<C>));
        return true;
    }

    HWY_INLINE bool isLeaf(const C& cursor) const { return cursor.primitiveCount != 0; }
    HWY_INLINE PrimitiveRange primitiveRange(const C& cursor) const {
        return {cursor.first, cursor.primitiveCount};
    }

  protected:
    /// Requests the pair below a node before it is known whether the ray needs it: incoherent rays wait for
    /// memory. For a leaf the address has no meaning, but a prefetch of any address is harmless.
    HWY_INLINE void prefetchBelow(const Node& node) const {
        const uintptr_t address = reinterpret_cast<uintptr_t>(nodes_) + size_t(node.first) * sizeof(Node);
        hwy::Prefetch(reinterpret_cast<const char*>(address));
    }
    HWY_INLINE void enter(Entered<C>& entered, uint32_t index, float at) const {
        entered.cursor.set(nodes_[index], index);
        entered.enter = at;
    }

    const Node* nodes_;
};

template <>
class Stepper<AabbForm> : public AabbPairs<AabbCursor> {
  public:
    using AabbPairs::AabbPairs;
};
static_assert(SteppableTree<Stepper<AabbForm>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
