// The interface that a form needs to be traced: steps of a ray through its nodes as they are stored.
//
// Each form has a Stepper in trace/step_FORM.h. Steppers, like the traversal loop (trace/traverse.h), are
// compiled once for each kind of processor.
#if defined(BVHIO_TRACE_STEPPER_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEPPER_H
#undef BVHIO_TRACE_STEPPER_H
#else
#define BVHIO_TRACE_STEPPER_H
#endif

#include <hwy/highway.h>

#include <concepts>

#include "compress/form_concept.h"
#include "metrics/no_metrics.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A node that a ray enters, as an entry of a traversal's stack.
template <class Cursor>
struct Entered {
    Entered() = default;
    HWY_INLINE Entered(const Cursor& entered, float at) : cursor(entered), enter(at) {}
    // Declared here, so that they are compiled for the same processor as the cursor's.
    Entered(const Entered&) = default;
    Entered& operator=(const Entered&) = default;

    Cursor cursor;  // the data with which the stepper continues from this node
    float enter;    // the ray's parameter where it enters the node's box
};

/// Steps through the nodes of the tree that a form stores. It is cheap to make, and refers to the form. The
/// specialisations are in trace/step_FORM.h.
template <class Form>
class Stepper;

/// Nodes that a ray steps through. Traversal (trace/traverse.h) is responsible for the stack and for culling.
/// A stepper defines its Cursor (an index; an index and a decoded box; an index and ray parameters) and:
///
/// - Ray: the type that it makes from a PreparedRay before the traversal, or a reference to a PreparedRay.
/// - kMaxPushed: the most entries that a step pushes.
/// - step: tests the boxes of the children of an inner node that was entered. Writes the nearest entered
///   child to `next`, and pushes the others to `top`, the farthest first. Of equally near children, the one
///   that is stored first counts as the nearest. Returns false, and pushes nothing, if no child is entered.
///   `next` may be `from`. A child is entered if its part of the ray, cut off at `tLimit`, is not empty. The
///   contract that makes hits the same for every form: enter a child whenever `clipToBox` accepts any box
///   inside the child's stored box, at this tLimit, and let `enter` not exceed the `enter` that `clipToBox`
///   finds for that box.
/// - isLeaf, primitiveRange: of a cursor. Leaves are entered, but never stepped from. If a stepper reads data
///   for the range that its cursor does not have, it has another primitiveRange, which also takes the
///   metrics.
///
/// Every fetched record of any kind, every tested box and every pushed entry is reported to the metrics.
template <class S>
concept SteppableNodes = requires(const S stepper, const typename S::Cursor cursor, const typename S::Ray ray,
                                  float tLimit, const Entered<typename S::Cursor> from,
                                  Entered<typename S::Cursor>& next, Entered<typename S::Cursor>*& top,
                                  NoMetrics metrics) {
    { S::kMaxPushed } -> std::convertible_to<int>;
    { stepper.step(from, ray, tLimit, next, top, metrics) } -> std::same_as<bool>;
    { stepper.isLeaf(cursor) } -> std::same_as<bool>;
    { stepper.primitiveRange(cursor) } -> std::same_as<PrimitiveRange>;
};

/// Nodes that are all below one root:
///
/// - prepare: makes its Ray from a PreparedRay.
/// - enterRoot: tests the root's box. Returns false if the ray misses it. If not, traversal starts at `root`.
template <class S>
concept SteppableTree = SteppableNodes<S> &&
    requires(const S stepper, const PreparedRay given, const typename S::Ray ray, float tLimit,
             Entered<typename S::Cursor>& root, NoMetrics metrics) {
    { stepper.prepare(given) } -> std::same_as<typename S::Ray>;
    { stepper.enterRoot(ray, tLimit, root, metrics) } -> std::same_as<bool>;
};

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
