// BLASes in the mvh form: trees without pointers, planes or counts; a byte for every four triangles.
//
// After P. Bauszat, M. Eisemann, M. Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010: the shape of a
// tree follows from the number of its primitives, and a child's box from its parent's by a short code that
// cuts fixed parts off. Departures, since these trees are small and many:
// - A code has 4 bits, not 2. It says which axis is cut; in the paper that is the longest, so a traversal
// needs
//   the box in space. With the axis said, a ray goes on with the places of planes that it brings from the top
//   level (compress/ray_frame.h), and boxes that are thin or share their longest axis with their parent
//   shrink sooner: 2 bits more a node take 10 to 25 % off the cost of a tree. There are two sizes of cuts of
//   one side.
// - A tree's nodes are split by halves of its leaves, so that all of a subtree's primitives are one run; the
// last
//   leaf is short, and no triangle is stored twice.
// - All trees share one array of bytes without a table: see MvhRun.
#pragma once

#include "compress/ray_frame.h"
#include "compress/root_places.h"
#include "compress/two_levels.h"
#include "core/shared_array.h"

namespace bvhio {

/// A node: the run of primitives below it.
///
/// Inner nodes are split behind the first half of their leaves, the larger half, at a primitive `middle`. The
/// codes of the two children are byte middle / kLeafSize of the array, the left child's in the lower bits.
/// Bytes are never shared: splits within a tree are kLeafSize or more apart, and the first split of a tree
/// lies at least that far behind its first primitive, which is behind every split of the trees before.
struct MvhRun {
    static constexpr uint32_t kLeafSize = 4;

    uint32_t first, count;

    BVHIO_INLINE bool isLeaf() const { return count <= kLeafSize; }
    BVHIO_INLINE uint32_t leafCount() const { return (count + kLeafSize - 1) / kLeafSize; }
    BVHIO_INLINE uint32_t leftCount() const { return (leafCount() + 1) / 2 * kLeafSize; }
    BVHIO_INLINE MvhRun left() const { return {first, leftCount()}; }
    BVHIO_INLINE MvhRun right() const { return {first + leftCount(), count - leftCount()}; }
    /// How many nodes there are below this one.
    size_t slotsBelow() const { return 2 * (size_t(leafCount()) - 1); }
    /// Of an inner node.
    BVHIO_INLINE uint32_t codes() const { return (first + leftCount()) / kLeafSize; }
};

/// What each code takes off the box, as parts of its size.
struct MvhCut {
    float min[3], max[3];
};
inline constexpr uint32_t kMvhCodes = 16;
/// Code 0 keeps the box. Codes 1 + 5 a to 5 + 5 a cut along axis a: 7/16 or 1/4 off the low side, 7/16 or 1/4
/// off the high side, 1/4 off both.
constexpr MvhCut mvhCut(uint32_t code) {
    MvhCut cut{};
    if (code == 0) return cut;
    const uint32_t axis = (code - 1) / 5, kind = (code - 1) % 5;
    constexpr float kLarge = 0.4375f, kSmall = 0.25f;
    if (kind < 2) cut.min[axis] = kind == 0 ? kLarge : kSmall;
    if (kind == 2 || kind == 3) cut.max[axis] = kind == 2 ? kLarge : kSmall;
    if (kind == 4) cut.min[axis] = cut.max[axis] = kSmall;
    return cut;
}
/// The same as a traversal loads it.
struct alignas(16) MvhMove {
    float min[4], max[4];
};
constexpr std::array<MvhMove, kMvhCodes> mvhMoves() {
    std::array<MvhMove, kMvhCodes> moves{};
    for (uint32_t code = 0; code < kMvhCodes; ++code) {
        const MvhCut cut = mvhCut(code);
        for (int axis = 0; axis < 3; ++axis) {
            moves[code].min[axis] = cut.min[axis];
            moves[code].max[axis] = cut.max[axis];
        }
    }
    return moves;
}
inline constexpr std::array<MvhMove, kMvhCodes> kMvhMoves = mvhMoves();
/// The box of a child.
InsetBox cutBox(const InsetFrame& frame, const InsetBox& box, uint32_t code);

class MvhBlases {
  public:
    static constexpr std::string_view kName = "mvh";
    static constexpr bool kAreRuns = true;
    static constexpr int kMaxChildren = 2;
    using Ray = RayFrame;

    struct Cursor {
        PlacedBox box;
        MvhRun run;
    };

    /// A byte for every four primitives.
    explicit MvhBlases(SharedArray<uint8_t> codes) : codes_(std::move(codes)) {}
    static size_t byteCount(size_t primitives) {
        return (primitives + MvhRun::kLeafSize - 1) / MvhRun::kLeafSize;
    }

    /// Of the trees over runs of `primitives` at `places`; puts these into the order of their trees. `boxes`
    /// has for each entry of `primitives` the box that must hold it, `ordered` where a run starts that is in
    /// such an order already its length, else 0. Parallel.
    static MvhBlases encode(const RootPlaces& places, std::span<uint32_t> primitives,
                            std::span<const Aabb> boxes, std::span<const uint32_t> ordered);
    Forest decode(const RootPlaces& places) const;

    const SharedArray<uint8_t>& codes() const { return codes_; }
    size_t nodeBytes() const { return codes_.size(); }

    static RayFrame prepare(const PreparedRay& ray, const Aabb& bounds) { return {ray, bounds}; }

    template <class Entry, class Metrics>
    BVHIO_INLINE Entered<Cursor> root(PrimitiveRange leaf, const Entry& entry, const RayFrame& ray,
                                      Metrics&) const {
        return {{entry.place(ray), {leaf.first, leaf.count}}, entry.enter};
    }

    /// Per pair: 3 differences for the size of the box, 6 products and 6 sums for the planes of each child, 3
    /// sums a child for the margin.
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        const MvhRun run = from.cursor.run;
        const uint32_t at = run.codes();
        metrics.recordFetched(at, 1);
        metrics.boxesTested(1, BoxTestCost{17, 12});
        metrics.boxesTested(1, BoxTestCost{16, 12});
        const uint32_t codes = codes_[at];
        const PlacedBox& box = from.cursor.box;
        const Four size = RayFrame::size(box);
        const PlacedBox left = cut(box, size, kMvhMoves[codes & 15]),
                        right = cut(box, size, kMvhMoves[codes >> 4]);
        const EnteredOfTwo found = ray.clip(left, right, tLimit);
        const auto enter = [&](const PlacedBox& childBox, MvhRun childRun, float where,
                               Entered<Cursor>& child) {
            child = {{childBox, childRun}, where};
        };
        switch (found.entered) {
            case 0:
                return 0;
            case 1:
                enter(left, run.left(), found.enter[0], children[0]);
                return 1;
            case 2:
                enter(right, run.right(), found.enter[1], children[0]);
                return 1;
            default:
                const bool rightFirst = found.enter[1] < found.enter[0];
                enter(left, run.left(), found.enter[0], children[rightFirst]);
                enter(right, run.right(), found.enter[1], children[!rightFirst]);
                return 2;
        }
    }
    bool isLeaf(const Cursor& cursor) const { return cursor.run.isLeaf(); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return {cursor.run.first, cursor.run.count}; }

  private:
    static BVHIO_INLINE PlacedBox cut(const PlacedBox& box, Four size, const MvhMove& move) {
        Four min, max;
        std::memcpy(&min, move.min, sizeof min);
        std::memcpy(&max, move.max, sizeof max);
        return {box.min + min * size, box.max - max * size};
    }

    SharedArray<uint8_t> codes_;
};
static_assert(SteppableForm<MvhBlases>);

}  // namespace bvhio
