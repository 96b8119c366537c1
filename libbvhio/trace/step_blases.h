// Steps rays through the bottom level of the two-level form. Compiled for each target, like trace/traverse.h.
//
// A BlasStepper steps through one tree of the level, starting at its root. The root's box is stored above it,
// in a leaf of the top level or with an instance. A RootEntry describes how the ray enters that box.
#if defined(BVHIO_TRACE_STEP_BLASES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_BLASES_H
#undef BVHIO_TRACE_STEP_BLASES_H
#else
#define BVHIO_TRACE_STEP_BLASES_H
#endif

#include "compress/blases.h"
#include "trace/ray_frame.h"
#include "trace/step_aabb.h"
#include "trace/step_quantized.h"
#include "trace/step_ssh.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A ray that enters the box of a BLAS's root before `tLimit`. The box is given in coordinates, or by its
/// places if it has been placed in a frame already.
class RootEntry {
  public:
    HWY_INLINE RootEntry(const PreparedRay& ray, const Aabb& box, float enter, float tLimit)
        : ray_(&ray), box_(&box), enter_(enter), tLimit_(tLimit) {}
    HWY_INLINE RootEntry(const RayFrame& frame, const PlacedBox& placed, float enter, float tLimit)
        : frame_(&frame), placed_(&placed), enter_(enter), tLimit_(tLimit) {}

    HWY_INLINE float enter() const { return enter_; }
    /// Returns the parameter where the ray leaves the box.
    HWY_INLINE float exit() const {
        return placed_ != nullptr ? frame_->clip(*placed_, tLimit_).exit
                                  : clipToBox(*ray_, *box_, tLimit_).exit;
    }
    /// Returns the box's places in `frame`. If the box has been placed already, `frame` must be the same
    /// frame.
    HWY_INLINE PlacedBox place(const RayFrame& frame) const {
        return placed_ != nullptr ? *placed_ : frame.place(*box_);
    }

  private:
    const PreparedRay* ray_ = nullptr;
    const Aabb* box_ = nullptr;
    const RayFrame* frame_ = nullptr;
    const PlacedBox* placed_ = nullptr;
    float enter_, tLimit_;
};

/// Steps through the BLAS of a leaf of the top level. In addition to the members of a stepper it has:
///
/// - prepare: makes its Ray from a PreparedRay and the box of the top level's root, or of the mesh.
/// - root: returns the root, where traversal starts, for a RootEntry.
template <class Blases>
class BlasStepper;

/// Fetches the root of one of many trees. Roots come after the nodes.
template <class Links, class Metrics>
HWY_INLINE const typename Links::Root& fetchRoot(const LinkedBlases<Links>& blases, uint32_t number,
                                                 Metrics& metrics) {
    using Root = typename Links::Root;
    metrics.recordFetched(blases.form().nodeBytes() + number * sizeof(Root), sizeof(Root));
    return blases.roots()[number];
}

template <>
class BlasStepper<AabbBlases> : public AabbPairs<AabbCursor> {
  public:
    BlasStepper(const AabbBlases& blases, PrimitiveRange leaf)
        : AabbPairs(blases.form()), blases_(blases), number_(leaf.first) {}

    static const PreparedRay& prepare(const PreparedRay& ray, const Aabb&) { return ray; }

    template <class Metrics>
    HWY_INLINE Entered<Cursor> root(const RootEntry& entry, const PreparedRay&, Metrics& metrics) const {
        const AabbRoot& stored = fetchRoot(blases_, number_, metrics);
        return {{stored.first, stored.primitiveCount}, entry.enter()};
    }

  private:
    const AabbBlases& blases_;
    uint32_t number_;
};

template <>
class BlasStepper<SshBlases> : public Stepper<SshForm> {
  public:
    BlasStepper(const SshBlases& blases, PrimitiveRange leaf)
        : Stepper(blases.form()), blases_(blases), number_(leaf.first) {}

    static SshRay prepare(const PreparedRay& ray, const Aabb&) { return SshRay(ray); }

    template <class Metrics>
    HWY_INLINE Entered<Cursor> root(const RootEntry& entry, const SshRay&, Metrics& metrics) const {
        return {{fetchRoot(blases_, number_, metrics), entry.exit()}, entry.enter()};
    }

  private:
    const SshBlases& blases_;
    uint32_t number_;
};

/// Boxes are relative to the root's.
template <>
class BlasStepper<QuantizedBlases> : public Stepper<QuantizedForm> {
  public:
    BlasStepper(const QuantizedBlases& blases, PrimitiveRange leaf)
        : Stepper(blases.form()), blases_(blases), number_(leaf.first) {}

    static RayFrame prepare(const PreparedRay& ray, const Aabb& bounds) { return {ray, bounds}; }

    template <class Metrics>
    HWY_INLINE Entered<Cursor> root(const RootEntry& entry, const RayFrame& ray, Metrics& metrics) const {
        const QuantizedRoot& stored = fetchRoot(blases_, number_, metrics);
        return {{entry.place(ray), stored.word, uint8_t(stored.highBits)}, entry.enter()};
    }

  private:
    const QuantizedBlases& blases_;
    uint32_t number_;
};

/// The part of a box that a code cuts off, in the layout that a step loads.
struct alignas(16) MvhMove {
    float min[4], max[4];
};
constexpr std::array<MvhMove, kNibbleCodes> mvhMoves() {
    std::array<MvhMove, kNibbleCodes> moves{};
    for (uint32_t code = 0; code < kNibbleCodes; ++code) {
        const NibbleCut cut = nibbleCut(code);
        for (int axis = 0; axis < 3; ++axis) {
            moves[code].min[axis] = cut.min[axis];
            moves[code].max[axis] = cut.max[axis];
        }
    }
    return moves;
}
inline constexpr std::array<MvhMove, kNibbleCodes> kMvhMoves = mvhMoves();

/// The data that all nodes of a tree share is here, so that a cursor needs only two numbers.
template <>
class BlasStepper<NibbleBlases> {
  public:
    using Ray = RayFrame;
    static constexpr int kMaxPushed = 1;

    struct Cursor {
        PlacedBox box;
        uint32_t leaf, leaves;  // the first below this node, counted from the tree's first, and how many
    };

    /// `run` are the primitives that the tree is over.
    HWY_INLINE BlasStepper(const NibbleBlases& blases, PrimitiveRange run)
        : codes_(blases.codes().data()),
          run_(run),
          leafSize_(blases.shape().leafSize()),
          root_(blases.shape().root(run)) {}

    static RayFrame prepare(const PreparedRay& ray, const Aabb& bounds) { return {ray, bounds}; }

    template <class Metrics>
    HWY_INLINE Entered<Cursor> root(const RootEntry& entry, const RayFrame& ray, Metrics&) const {
        return {{entry.place(ray), 0, root_.leaves}, entry.enter()};
    }

    /// Per pair: 3 differences for the size of the box, 6 products and 6 sums for the planes of each child, 3
    /// sums a child for the margin.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                         Entered<Cursor>& next, Entered<Cursor>*& top, Metrics& metrics) const {
        const uint32_t leaf = from.cursor.leaf, leaves = from.cursor.leaves, leftLeaves = (leaves + 1) / 2;
        const uint32_t at = root_.slot + leaf + leftLeaves;  // as NibbleRun::codes
        metrics.recordFetched(at, 1);
        metrics.boxesTested(1, BoxTestCost{17, 12});
        metrics.boxesTested(1, BoxTestCost{16, 12});
        const uint32_t codes = codes_[at];
        const PlacedBox& box = from.cursor.box;
        const Four size = box.size();
        const PlacedBox left = cut(box, size, kMvhMoves[codes & 15]),
                        right = cut(box, size, kMvhMoves[codes >> 4]);
        const EnteredOfTwo found = ray.clip(left, right, tLimit);
        const auto enter = [&](int child, Entered<Cursor>& entered) HWY_ATTR {
            entered = child == 0
                          ? Entered<Cursor>{{left, leaf, leftLeaves}, found.enter[0]}
                          : Entered<Cursor>{{right, leaf + leftLeaves, leaves - leftLeaves}, found.enter[1]};
        };
        return enterInOrder(found, enter, next, top, metrics);
    }

    HWY_INLINE bool isLeaf(const Cursor& cursor) const { return cursor.leaves <= 1; }
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor) const {
        const uint32_t before = cursor.leaf * leafSize_, left = run_.count - before;
        return {run_.first + before, left < leafSize_ ? left : leafSize_};
    }

  private:
    static HWY_INLINE PlacedBox cut(const PlacedBox& box, Four size, const MvhMove& move) {
        Four min, max;
        std::memcpy(&min, move.min, sizeof min);
        std::memcpy(&max, move.max, sizeof max);
        return {box.min + min * size, box.max - max * size};
    }

    const uint8_t* codes_;
    PrimitiveRange run_;
    uint32_t leafSize_;
    NibbleRun root_;
};
static_assert(SteppableNodes<BlasStepper<AabbBlases>> && SteppableNodes<BlasStepper<SshBlases>> &&
              SteppableNodes<BlasStepper<QuantizedBlases>> && SteppableNodes<BlasStepper<NibbleBlases>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
