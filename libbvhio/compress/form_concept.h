// What a form must offer: how nodes are stored, and how a ray steps through them as stored.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/intersect.h"
#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// A run of entries in the form's primitive array.
struct PrimitiveRange {
    uint32_t first, count;
};

/// A node that a ray enters, as the stack of a traversal remembers it.
template <class Cursor>
struct Entered {
    Cursor cursor;  // what the form needs to go on from this node
    float enter;    // the ray's parameter where it enters the node's box
};

/// The arithmetic of one box test: subtractions and multiplications, and comparisons (minima and maxima
/// included).
struct BoxTestCost {
    uint32_t arithmetic, comparisons;
};

/// The metrics policy that is free: each call vanishes. Others are in metrics/metrics.h and
/// metrics/locality.h.
struct NoMetrics {
    BVHIO_INLINE void recordFetched(size_t, size_t) {}       // byte offset among the form's nodes, bytes
    BVHIO_INLINE void boxesTested(uint32_t, BoxTestCost) {}  // how many boxes, the cost of each
    BVHIO_INLINE void leafEntered(PrimitiveRange) {}
    BVHIO_INLINE void pushed(size_t) {
    }  // bytes of the entry; each pushed entry is popped once, unless an any-hit query ends
    BVHIO_INLINE void popped(size_t) {}
};

/// How the mvh form divides triangles: with much choice, as its paper does (compress/mvh_build.h), or as the
/// given tree does, if that has the form's shape; others count as best.
enum class MvhBuild { best, paper, given };

/// Forms of the two-level form's levels, the default first.
enum class TlasForm : uint8_t { quantized, aabb };
enum class BlasForm : uint8_t { mvh, ssh, quantized, aabb };

/// What forms can be told; each takes what concerns it.
struct EncodeOptions {
    uint32_t bits = 8;  // quantized, a level of two in that form, too: of a plane, 5 to 8

    // quantized-short, for trees that are not in clusters
    uint32_t pointerBits = 8;  // 2 to 10
    uint32_t lineSize = 64;    // bytes: a power of two, 8 to 512

    // mvh
    uint32_t leafSize = 4;           // triangles in a leaf, 1 to 16
    float zeta = 0, zetaOfBoth = 0;  // 0, and below: as suits the tree
    uint32_t cutAxes = 0;
    MvhBuild mvhBuild = MvhBuild::best;

    // two-level
    TlasForm tlasForm{};
    BlasForm blasForm{};
    uint32_t blasSize = 80;      // primitives that a BLAS has at most, unless a single leaf has more
    uint32_t blasLeafSize = 16;  // of BLASes in the mvh form: triangles in a leaf, 1 to 16

    bool operator==(const EncodeOptions&) const = default;
};

/// Nodes that a ray steps through as they are stored. Traversal (trace/traverse.h) owns the stack, the order
/// and the culling; a form owns its Cursor (an index; an index and a decoded box; an index and ray
/// parameters) and:
///
/// - Ray: what it makes of a PreparedRay once before the traversal; a reference to that where nothing.
/// - step: from an inner node as it was entered, tests the children's boxes and writes those entered to
/// `children`, nearest first (equal
///   ones in stored order); returns how many. A child is entered when its part of the ray, cut off at
///   `tLimit`, is not empty. The contract that makes hits the same for every form: accept a child whenever
///   `clipToBox` accepts any box inside the child's stored box, at this tLimit, and let `enter` not exceed
///   the `enter` that it finds for that box.
/// - isLeaf, primitiveRange: of a cursor; leaves are entered, never stepped from.
///   A form that reads for the range what its cursor does not hold has another primitiveRange, which takes
///   the metrics too.
///
/// Each record fetched, of whatever kind, and each box tested is told to the metrics.
template <class F>
concept SteppableForm = requires(const F form, const typename F::Cursor cursor, const typename F::Ray ray,
                                 float tLimit, const Entered<typename F::Cursor> entered,
                                 Entered<typename F::Cursor>* children, NoMetrics metrics) {
    { F::kMaxChildren } -> std::convertible_to<int>;
    { form.step(entered, ray, tLimit, children, metrics) } -> std::same_as<int>;
    { form.isLeaf(cursor) } -> std::same_as<bool>;
    { form.primitiveRange(cursor) } -> std::same_as<PrimitiveRange>;
};

/// A form stores a BVH and decodes it. One whose nodes are all of a kind is a Form; others (the two-level
/// form) have a traversal of their own.
///
/// - encode: of a valid tree over the scene. Boxes may grow; leaves keep their triangles, but may be divided.
template <class F>
concept StoredForm = requires(const F form, const Scene scene, const Bvh bvh, const EncodeOptions options) {
    { F::encode(scene, bvh, options) } -> std::same_as<F>;
    { form.options() } -> std::same_as<EncodeOptions>;  // that encode another tree alike
    { F::kName } -> std::convertible_to<std::string_view>;
    { F::kSummary } -> std::convertible_to<std::string_view>;
    { form.decode() } -> std::same_as<Bvh>;                                   // boxes as reconstructed
    { form.primitives() } -> std::convertible_to<std::span<const uint32_t>>;  // leaf order -> triangle
    { form.nodeBytes() } -> std::same_as<size_t>;                             // in memory, nodes only
};

/// A form whose nodes, from the root down, are all stepped through alike:
///
/// - prepare: makes its Ray of a PreparedRay.
/// - enterRoot: tests the root's box; false when the ray misses it. Else `root` is where traversal starts.
template <class F>
concept Form = StoredForm<F> && SteppableForm<F> &&
    requires(const F form, const PreparedRay given, const typename F::Ray ray, float tLimit,
             Entered<typename F::Cursor>& root, NoMetrics metrics) {
    { form.prepare(given) } -> std::same_as<typename F::Ray>;
    { form.enterRoot(ray, tLimit, root, metrics) } -> std::same_as<bool>;
};

}  // namespace bvhio
