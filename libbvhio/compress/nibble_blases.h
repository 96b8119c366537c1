// BLASes in the nibble encoding: trees without pointers, planes or counts; a byte for every leaf. Users know it
// as mvh, the name of its paper; what the mvh form stores is another encoding, of 2 bits (compress/mvh_tree.h).
//
// After P. Bauszat, M. Eisemann, M. Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010: the shape of a
// tree follows from the number of its primitives, and a child's box from its parent's by a short code that
// cuts fixed parts off. Departures, since these trees are small and many:
//
// - A code has 4 bits, not 2. It says which axis is cut; in the paper that is the longest, so a traversal
//   needs the box in space. With the axis said, a ray goes on with the places of planes that it brings from
//   the top level (trace/ray_frame.h), and boxes that are thin or share their longest axis with their parent
//   shrink sooner: 2 bits more a node take 10 to 25% off the cost of a tree. There are two sizes of cuts of
//   one side.
// - A tree's nodes are split by halves of its leaves, so that all of a subtree's primitives are one run; the
//   last leaf is short, and no triangle is stored twice.
// - All trees share one array of bytes without a table: see NibbleRuns.
#pragma once

#include "compress/forest.h"
#include "compress/root_places.h"
#include "core/shared_array.h"

namespace bvhio {

/// A node: the run of primitives below it, and how many leaves they fill.
struct NibbleRun {
    uint32_t first, count;
    uint32_t slot;  // first / leafSize, rounded down
    uint32_t leaves;

    BVHIO_INLINE bool isLeaf() const { return leaves <= 1; }
    /// Of an inner node: the number of leaves below its left child, and the index of its children's byte.
    BVHIO_INLINE uint32_t leftLeaves() const { return (leaves + 1) / 2; }
    BVHIO_INLINE uint32_t codes() const { return slot + leftLeaves(); }
    /// Returns the number of nodes below this one.
    size_t slotsBelow() const { return 2 * (size_t(leaves) - 1); }
};

/// The shape of trees whose leaves have a given number of primitives. The last leaf has the rest.
///
/// An inner node is split after the first half of its leaves, the larger half, at a primitive `middle`. The
/// codes of the two children are byte middle / leafSize of the array, the left child's in the lower bits. No
/// two nodes share a byte: splits within a tree are leafSize or more apart, and the first split of a tree is
/// at least leafSize after its first primitive, which is after every split of the trees before.
class NibbleRuns {
  public:
    static constexpr uint32_t kMaxLeafSize = 16;
    static constexpr uint32_t kMaxReferences = 1u << 29;

    explicit NibbleRuns(uint32_t leafSize)
        : leafSize_(leafSize), reciprocal_(((uint64_t(1) << kShift) + leafSize - 1) / leafSize) {}

    uint32_t leafSize() const { return leafSize_; }
    BVHIO_INLINE NibbleRun root(PrimitiveRange run) const {
        return {run.first, run.count, inLeaves(run.first), inLeaves(run.count + leafSize_ - 1)};
    }
    /// Return the children of an inner node, without a division.
    BVHIO_INLINE NibbleRun left(const NibbleRun& run) const {
        return {run.first, run.leftLeaves() * leafSize_, run.slot, run.leftLeaves()};
    }
    BVHIO_INLINE NibbleRun right(const NibbleRun& run) const {
        const uint32_t left = run.leftLeaves();
        return {run.first + left * leafSize_, run.count - left * leafSize_, run.slot + left,
                run.leaves - left};
    }
    /// Returns the size of the array of codes: one byte for each leaf that the primitives could fill.
    size_t byteCount(size_t primitives) const { return (primitives + leafSize_ - 1) / leafSize_; }

  private:
    static constexpr uint32_t kShift = 34;

    /// Returns n / leafSize, rounded down, for n below 2^30. The product with the reciprocal is too large by
    /// less than n / 2^34. That is below 1 / 16, so it never reaches the next whole number.
    BVHIO_INLINE uint32_t inLeaves(uint32_t n) const { return uint32_t(n * reciprocal_ >> kShift); }

    uint32_t leafSize_;
    uint64_t reciprocal_;  // 2^34 / leafSize, rounded up
};

/// How far a code moves each side of the box inwards, as a part of the box's size.
struct NibbleCut {
    float min[3], max[3];
};
inline constexpr uint32_t kNibbleCodes = 16;
/// Returns what a code cuts. Code 0 keeps the box. Codes 1 + 5 a to 5 + 5 a cut along axis a: 7/16 or 1/4 off
/// the low side, 7/16 or 1/4 off the high side, 1/4 off both.
constexpr NibbleCut nibbleCut(uint32_t code) {
    NibbleCut cut{};
    if (code == 0) return cut;
    const uint32_t axis = (code - 1) / 5, kind = (code - 1) % 5;
    constexpr float kLarge = 0.4375f, kSmall = 0.25f;
    if (kind < 2) cut.min[axis] = kind == 0 ? kLarge : kSmall;
    if (kind == 2 || kind == 3) cut.max[axis] = kind == 2 ? kLarge : kSmall;
    if (kind == 4) cut.min[axis] = cut.max[axis] = kSmall;
    return cut;
}
/// Returns the box of a child with this code.
InsetBox cutBox(const InsetFrame& frame, const InsetBox& box, uint32_t code);

class NibbleBlases {
  public:
    static constexpr std::string_view kName = "mvh";
    static constexpr std::string_view kSummary = "a byte per leaf, trees of their own (after Minimal BVH)";
    static constexpr bool kAreRuns = true;

    NibbleBlases(uint32_t leafSize, SharedArray<uint8_t> codes)
        : shape_(leafSize), codes_(std::move(codes)) {}

    /// Builds trees with leaves of this size over the runs of `primitives` at `places`, and puts the
    /// primitives into the order of their trees. `boxes` has for each entry of `primitives` the box that must
    /// hold it. `ordered` has, at the start of a run that already is in a tree's order, the run's length, and
    /// 0 elsewhere. Throws Error{unsupported} above 2^29 references. Parallel.
    static NibbleBlases encode(uint32_t leafSize, const RootPlaces& places, std::span<uint32_t> primitives,
                               std::span<const Aabb> boxes, std::span<const uint32_t> ordered);
    Forest decode(const RootPlaces& places) const;

    const NibbleRuns& shape() const { return shape_; }
    const SharedArray<uint8_t>& codes() const { return codes_; }
    size_t nodeBytes() const { return codes_.size(); }

  private:
    NibbleRuns shape_;
    SharedArray<uint8_t> codes_;
};

}  // namespace bvhio
