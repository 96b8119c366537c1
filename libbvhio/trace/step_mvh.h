// Steps rays through a tree of the mvh form (compress/mvh_tree.h), two levels at once. The four grandchildren
// of a node are in the four lanes of vectors.
//
// A step down mostly waits for results: for the sizes of a box, then for the axis, then for its planes, then
// for the next box. So neither branches nor addresses depend on the axis here: it is a mask.
//
// Boxes are stored as near and far planes of the ray. For a ray that goes down an axis, the signs of MvhCuts'
// sums are swapped. This does not change rounding, so the planes are the same numbers. Each plane on the way
// down is clipped by the arithmetic of clipToPlanes. So the interval is the one that clipToPlanes finds for
// the box of all these planes.
//
// The vectors are the compiler's, for any processor. On a processor without vectors they become loops.
// Compiled for each target, like trace/traverse.h.
#if defined(BVHIO_TRACE_STEP_MVH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BVHIO_TRACE_STEP_MVH_H
#undef BVHIO_TRACE_STEP_MVH_H
#else
#define BVHIO_TRACE_STEP_MVH_H
#endif

#include "compress/mvh_form.h"
#include "trace/mvh_cursor.h"
#include "trace/ray_frame.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio::HWY_NAMESPACE {

/// A ray, with the numbers that its steps need, by axis and in all four lanes.
struct MvhRay {
    struct Axis {
        Four origin, near, minusFar;  // reciprocals
        FourInts backwards;           // all ones if the ray goes down the axis
    };

    const PreparedRay& ray;
    Axis axes[3];

    explicit MvhRay(const PreparedRay& prepared) : ray(prepared) {
        for (int a = 0; a < 3; ++a) {
            const float origin = component(ray.origin, a), near = component(ray.nearReciprocal, a),
                        minusFar = -component(ray.farReciprocal, a);
            const int32_t backwards = ray.nearPlane[a] != uint32_t(a) ? -1 : 0;
            for (int lane = 0; lane < 4; ++lane) {
                axes[a].origin[lane] = origin;
                axes[a].near[lane] = near;
                axes[a].minusFar[lane] = minusFar;
                axes[a].backwards[lane] = backwards;
            }
        }
    }
};

/// Returns the box of a tree's root, which the ray enters in `interval`.
HWY_INLINE MvhPart mvhPart(const MvhRay& ray, const Aabb& box, RayInterval interval) {
    MvhPart part;
    for (int a = 0; a < 3; ++a) {
        const bool backwards = ray.axes[a].backwards[0] != 0;
        part.near[a] = component(backwards ? box.max : box.min, a);
        part.far[a] = component(backwards ? box.min : box.max, a);
    }
    part.near[3] = interval.enter;
    part.far[3] = -interval.exit;
    return part;
}

/// The order in which a step visits lanes: a byte for each, from the lowest on. The indices are a mask of
/// what is swapped (bit 0: the left and right child; bits 1 and 2: their children), and a mask of entered
/// lanes.
struct MvhOrder {
    uint32_t lanes[8][16];
    constexpr MvhOrder() : lanes{} {
        for (uint32_t swapped = 0; swapped < 8; ++swapped)
            for (uint32_t entered = 0; entered < 16; ++entered) {
                uint32_t count = 0;
                for (uint32_t i = 0; i < 4; ++i) {
                    const uint32_t child = i / 2 ^ (swapped & 1);
                    const uint32_t lane = 2 * child + (i % 2 ^ (swapped >> (1 + child) & 1));
                    if (entered >> lane & 1) lanes[swapped][entered] |= lane << 8 * count++;
                }
            }
    }
};
inline constexpr MvhOrder kMvhOrder;

/// The result of a step: the entered nodes, the nearest first.
struct MvhStep {
    uint32_t count;
    // A byte for each entered node: its lane. Lanes 0 to 3 are the grandchildren. With one level, lane 0 is
    // the left child, and lane 2 the right one.
    uint32_t lanes;
    MvhPart parts[4];  // by lane
    FourInts turns;

    HWY_INLINE uint32_t lane(uint32_t i) const { return lanes >> 8 * i & 3; }
};

/// The vectors of a step.
struct MvhLanes {
    Four near[3], far[3], enter, minusExit;
    FourInts turn;  // minus the turns (MvhBox::turn)

    template <int lane>
    static HWY_INLINE Four all(Four v) {
        return __builtin_shufflevector(v, v, lane, lane, lane, lane);
    }
    static HWY_INLINE Four all(float v) { return Four{v, v, v, v}; }
    static HWY_INLINE FourInts all(int32_t v) { return FourInts{v, v, v, v}; }
    static HWY_INLINE Four blend(FourInts mask, Four a, Four b) { return mask ? a : b; }

    HWY_INLINE MvhLanes(const MvhPart& part, uint32_t startTurn, float tLimit)
        : near{all<0>(part.near), all<1>(part.near), all<2>(part.near)},
          far{all<0>(part.far), all<1>(part.far), all<2>(part.far)},
          enter(all<3>(part.near)),
          minusExit(max(all<3>(part.far), all(-tLimit))),
          turn(-all(int32_t(startTurn))) {}

    /// Goes from nodes to their children. `low`, `swap` and `none` are those of the children's codes in
    /// MvhTables::Lanes. Returns all ones in lanes where the ray goes down the axis that is cut.
    HWY_INLINE FourInts descend(const MvhRay& ray, uint32_t axes, FourInts low, FourInts swap,
                                FourInts none) {
        // Compute the sizes of the boxes. Differences are negative if the ray goes down an axis.
        Four sizes[3], lengths[3];
        for (int a = 0; a < 3; ++a) {
            sizes[a] = far[a] - near[a];
            lengths[a] = Four(FourInts(sizes[a]) & all(0x7fffffff));
        }
        // Select the axis that is cut. Its place in the order of sizes is the number of longer axes.
        const FourInts y = lengths[1] > lengths[0], z = lengths[2] > lengths[0], zy = lengths[2] > lengths[1];
        const FourInts isX = (y + z) == turn, isY = (~y + zy) == turn, isZ = ~(isX | isY);
        const auto select = [&](Four ofX, Four ofY, Four ofZ) {
            return blend(isX, ofX, blend(isY, ofY, ofZ));
        };
        const auto ofRay = [&](const auto& member) {
            return select(Four(ray.axes[0].*member), Four(ray.axes[1].*member), Four(ray.axes[2].*member));
        };
        // Move its planes.
        const Four largest = all(std::numeric_limits<float>::max());
        const Four size = max(min(select(sizes[0], sizes[1], sizes[2]), largest), -largest);
        const auto backwards = FourInts(ofRay(&MvhRay::Axis::backwards));
        const FourInts nearPart = low ^ (backwards & swap), farPart = nearPart ^ swap;
        const Four nearPlane = select(near[0], near[1], near[2]) + Four(nearPart) * size;
        const Four farPlane = select(far[0], far[1], far[2]) - Four(farPart) * size;
        const Four origin = ofRay(&MvhRay::Axis::origin);
        // Clip the intervals. The maximum of a NaN and a number is the second operand, the number, as in
        // clipToPlanes. The end of an interval is stored with its sign swapped.
        enter = max((nearPlane - origin) * ofRay(&MvhRay::Axis::near), enter);
        minusExit = max((farPlane - origin) * ofRay(&MvhRay::Axis::minusFar), minusExit);
        // Store the planes, and whose turn it is below.
        const FourInts masks[3] = {isX, isY, isZ};
        for (int a = 0; a < 3; ++a) {
            near[a] = blend(masks[a], nearPlane, near[a]);
            far[a] = blend(masks[a], farPlane, far[a]);
        }
        const FourInts next = turn - 1;
        turn = none & next & ~(next == all(-int32_t(axes)));
        return backwards;
    }

    /// Returns which lanes come after their sibling, whose `enter` is in `neighbours`. If both are equally
    /// near, the direction along the cut axis decides, since builders put the lower child to the left.
    HWY_INLINE FourInts isAfter(Four neighbours, FourInts backwards) const {
        return (neighbours < enter) | (backwards & (neighbours == enter));
    }
};

/// The transpose of four vectors: one vector for each lane.
struct MvhRows {
    Four of[4];

    HWY_INLINE MvhRows(Four a, Four b, Four c, Four d) {
        const Four abLow = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                   cdLow = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                   abHigh = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                   cdHigh = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        of[0] = __builtin_shufflevector(abLow, cdLow, 0, 1, 4, 5);
        of[1] = __builtin_shufflevector(abLow, cdLow, 2, 3, 6, 7);
        of[2] = __builtin_shufflevector(abHigh, cdHigh, 0, 1, 4, 5);
        of[3] = __builtin_shufflevector(abHigh, cdHigh, 2, 3, 6, 7);
    }
};

/// Returns a bit for each lane of a mask.
HWY_INLINE uint32_t bitsOf(FourInts mask) {
#if defined(__SSE__)
    return uint32_t(_mm_movemask_ps(__m128(mask)));
#else
    return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
}

/// Tests the children of a node against the ray and, if `twoLevels`, its grandchildren too. `codes` is the
/// node's nibble. With two levels, `leftCodes` and `rightCodes` are the children's nibbles, otherwise 0. If a
/// child is missed, its children are missed too.
HWY_INLINE void stepMvh(const MvhTables& tables, const MvhRay& ray, uint32_t codes, uint32_t leftCodes,
                        uint32_t rightCodes, bool twoLevels, const MvhPart& part, uint32_t turn, float tLimit,
                        MvhStep& step) {
    MvhLanes lanes(part, turn, tLimit);
    const auto load4 = [](const auto& values) {
        FourInts loaded;
        std::memcpy(&loaded, values.data(), sizeof loaded);
        return loaded;
    };
    // Go down to the children.
    const MvhTables::Lanes<4>& first = tables.children[codes];
    FourInts backwards =
        lanes.descend(ray, tables.axes, load4(first.low), load4(first.swap), load4(first.none));
    uint32_t swapped =
        bitsOf(lanes.isAfter(__builtin_shufflevector(lanes.enter, lanes.enter, 2, 3, 0, 1), backwards)) & 1;
    // Go down to the grandchildren.
    if (twoLevels) {
        const auto load2 = [](const auto& left, const auto& right) {
            using Two = int64_t __attribute__((vector_size(16)));
            int64_t halves[2];
            std::memcpy(&halves[0], left.data(), 8);
            std::memcpy(&halves[1], right.data(), 8);
            return FourInts(Two{halves[0], halves[1]});
        };
        const MvhTables::Lanes<2>&left = tables.grandchildren[leftCodes],
              &right = tables.grandchildren[rightCodes];
        backwards = lanes.descend(ray, tables.axes, load2(left.low, right.low), load2(left.swap, right.swap),
                                  load2(left.none, right.none));
        const uint32_t below =
            bitsOf(lanes.isAfter(__builtin_shufflevector(lanes.enter, lanes.enter, 1, 0, 3, 2), backwards));
        swapped |= (below & 1) << 1 | (below & 4);
    }
    // Collect the entered nodes.
    const uint32_t entered = bitsOf(lanes.enter <= -lanes.minusExit) & (twoLevels ? 15 : 5);
    step.count = uint32_t(std::popcount(entered));
    step.lanes = kMvhOrder.lanes[swapped][entered];
    step.turns = -lanes.turn;
    const MvhRows nearRows(lanes.near[0], lanes.near[1], lanes.near[2], lanes.enter);
    const MvhRows farRows(lanes.far[0], lanes.far[1], lanes.far[2], lanes.minusExit);
    for (uint32_t i = 0; i < 4; ++i) {
        step.parts[i].near = nearRows.of[i];
        step.parts[i].far = farRows.of[i];
    }
}

template <>
class Stepper<MvhForm> {
  public:
    using Cursor = MvhCursor;
    using Ray = MvhRay;
    static constexpr int kMaxPushed = 3;
    /// The cost per box. Both children share 3 sizes, 2 products, 4 planes and 2 comparisons for the axis;
    /// half of these count. Each box has 2 differences and 2 products, and 2 comparisons for the interval and
    /// 2 for the test.
    static constexpr BoxTestCost kBoxTestCost{9, 5};

    explicit Stepper(const MvhForm& form)
        : form_(form), tables_(form.tables()), shape_(form.shape()), words_(form.words().data()) {}

    MvhRay prepare(const PreparedRay& ray) const { return MvhRay(ray); }

    template <class Metrics>
    HWY_INLINE bool enterRoot(const MvhRay& ray, float tLimit, Entered<Cursor>& root,
                              Metrics& metrics) const {
        metrics.boxesTested(1, kFullBoxTestCost);
        const RayInterval interval = clipToBox(ray.ray, form_.bounds(), tLimit);
        root = {{mvhPart(ray, form_.bounds(), interval), 0, 0}, interval.enter};
        return !interval.isEmpty();
    }

    /// A record is the word that holds a node's nibble. The words of siblings count as one.
    template <class Metrics>
    HWY_INLINE bool step(const Entered<Cursor>& from, const MvhRay& ray, float tLimit, Entered<Cursor>& next,
                         Entered<Cursor>*& top, Metrics& metrics) const {
        const uint32_t node = from.cursor.node(), left = 2 * node + 1;
        const bool twoLevels = left + 1 < shape_.innerCount();
        metrics.boxesTested(twoLevels ? 6 : 2, kBoxTestCost);
        metrics.recordFetched(size_t(node) / 8 * sizeof(uint32_t), sizeof(uint32_t));
        if (twoLevels) metrics.recordFetched(size_t(left) / 8 * sizeof(uint32_t), sizeof(uint32_t));
        MvhStep step;
        stepMvh(tables_, ray, mvhNibble(words_, node), twoLevels ? mvhNibble(words_, left) : 0,
                twoLevels ? mvhNibble(words_, left + 1) : 0, twoLevels, from.cursor.part, from.cursor.turn(),
                tLimit, step);
        const auto enter = [&](uint32_t i, Entered<Cursor>& entered) HWY_ATTR {
            const uint32_t lane = step.lane(i);
            const uint32_t child = twoLevels ? 2 * left + 1 + lane : left + lane / 2;
            entered.cursor = {step.parts[lane], child, uint32_t(step.turns[lane])};
            entered.enter = step.parts[lane].enter();
        };
        for (uint32_t i = step.count; i > 1; --i) {
            enter(i - 1, *top++);
            metrics.pushed(sizeof(Entered<Cursor>));
        }
        enter(0, next);  // without meaning if no node is entered
        return step.count != 0;
    }

    HWY_INLINE bool isLeaf(const Cursor& cursor) const { return shape_.isLeaf(cursor.node()); }
    HWY_INLINE PrimitiveRange primitiveRange(const Cursor& cursor) const {
        return shape_.primitiveRange(cursor.node());
    }

  private:
    const MvhForm& form_;
    const MvhTables& tables_;
    const MvhShape& shape_;
    const uint32_t* words_;
};
static_assert(SteppableTree<Stepper<MvhForm>>);

}  // namespace bvhio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
