// What a form must bring to be traced: how a ray steps through its nodes as they are stored.
//
// Each form has a Stepper in trace/step_FORM.h. Like the traversal loop (trace/traverse.h) steppers are
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

/// A node that a ray enters, as the stack of a traversal remembers it.
template <class Cursor>
struct Entered {
    Cursor cursor;  // what the stepper needs to go on from this node
    float enter;    // the ray's parameter where it enters the node's box
};

/// Steps through the nodes of the tree that a form stores. It is cheap to make, and refers to the form.
/// Specialised in trace/step_FORM.h.
template <class Form>
class Stepper;

/// Nodes that a ray steps through. Traversal (trace/traverse.h) owns the stack and the culling. A stepper
/// owns its Cursor (an index; an index and a decoded box; an index and ray parameters) and:
///
/// - Ray: what it makes of a PreparedRay once before the traversal; a reference to that where nothing.
/// - kMaxPushed: how many entries a step may push.
/// - step: from an inner node as it was entered, tests the boxes of the children. Writes the nearest child
///   that is entered to `next`, and pushes the others to `top`, the farthest first; of equally near ones
///   the first as stored is the nearest. Returns false, and pushes nothing, when no child is entered.
///   `next` is not `from`. A child is entered when its part of the ray, cut off at `tLimit`, is not empty.
///   The contract that makes hits the same for every form: enter a child whenever `clipToBox` accepts any
///   box inside the child's stored box, at this tLimit, and let `enter` not exceed the `enter` that it
///   finds for that box.
/// - isLeaf, primitiveRange: of a cursor; leaves are entered, never stepped from.
///   A stepper that reads for the range what its cursor does not hold has another primitiveRange, which takes
///   the metrics too.
///
/// Each record fetched, of whatever kind, each box tested and each entry pushed is reported to the metrics.
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

/// Nodes that all lie below one root:
///
/// - prepare: makes its Ray of a PreparedRay.
/// - enterRoot: tests the root's box; false when the ray misses it. Else `root` is where traversal starts.
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
