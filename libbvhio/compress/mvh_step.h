// How a ray steps through a tree of the mvh form (compress/mvh_tree.h): two levels at once, the four
// grandchildren of a node beside each other in the lanes of vectors.
//
// What a step down takes is mostly time to wait: for the sizes of a box, then for the axis, then for its
// planes, then for the next box. So neither branches nor addresses depend on the axis here: it is a mask.
//
// Boxes are held as the ray meets their planes, near and far. For a ray that goes down an axis the signs of
// MvhCuts' sums are swapped, which rounding does not see: the planes are the same numbers. Each one on the
// way down is clipped by the arithmetic of clipToPlanes, so the interval is what that finds for the box that
// all of them bound.
#pragma once

#include <algorithm>
#include <array>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "compress/mvh_tree.h"

namespace bvhio {

/// What steps look up, by the rule alone: one for all trees that share it.
class MvhTables {
  public:
    explicit MvhTables(const MvhRule& rule) : axes(rule.axes) {
        for (uint32_t codes = 0; codes < 16; ++codes)
            for (uint32_t lane = 0; lane < 4; ++lane) {
                fill(rule, codes >> (lane < 2 ? 0 : 2) & 3, lane, children[codes]);
                if (lane < 2) fill(rule, codes >> 2 * lane & 3, lane, grandchildren[codes]);
            }
    }

    /// For each lane: how far a ray that goes up an axis has the near plane moved, as a part of the size;
    /// which bits make that the far plane's; and all ones where the code is none.
    template <size_t lanes>
    struct Lanes {
        alignas(4 * lanes) std::array<float, lanes> low;
        std::array<uint32_t, lanes> swap, none;
    };
    uint32_t axes;
    Lanes<4> children[16];       // by a nibble: left, left, right, right
    Lanes<2> grandchildren[16];  // by a nibble: left, right

  private:
    template <size_t lanes>
    static void fill(const MvhRule& rule, uint32_t code, uint32_t lane, Lanes<lanes>& to) {
        const float zeta = code == kMvhBoth ? rule.zetaOfBoth : rule.zeta;
        to.low[lane] = code & kMvhLow ? zeta : 0;
        to.swap[lane] =
            std::bit_cast<uint32_t>(to.low[lane]) ^ std::bit_cast<uint32_t>(code & kMvhHigh ? zeta : 0.0f);
        to.none[lane] = code == kMvhNone ? ~0u : 0;
    }
};

/// A ray with what its steps need, by axis and for four lanes.
struct MvhRay {
    struct Axis {
        alignas(16) float origin[4], near[4], minusFar[4];  // reciprocals
        uint32_t backwards[4];                              // all ones where the ray goes down the axis
    };

    const PreparedRay& ray;
    Axis axes[3];

    explicit MvhRay(const PreparedRay& prepared) : ray(prepared) {
        for (int a = 0; a < 3; ++a)
            for (int lane = 0; lane < 4; ++lane) {
                axes[a].origin[lane] = component(ray.origin, a);
                axes[a].near[lane] = component(ray.nearReciprocal, a);
                axes[a].minusFar[lane] = -component(ray.farReciprocal, a);
                axes[a].backwards[lane] = ray.nearPlane[a] != uint32_t(a) ? ~0u : 0;
            }
    }
};

/// A node that a ray enters: its box, the ray's interval in it, and whose turn it is. With the node's number
/// it is all that a step needs, so a tree starts from any box and interval at no cost.
struct MvhPart {
    float near[3], enter, far[3], minusExit;
    uint32_t turn;

    MvhPart() = default;
    /// Of a root.
    BVHIO_INLINE MvhPart(const MvhRay& ray, const Aabb& box, RayInterval interval) {
        for (int a = 0; a < 3; ++a) {
            const bool backwards = ray.axes[a].backwards[0] != 0;
            near[a] = component(backwards ? box.max : box.min, a);
            far[a] = component(backwards ? box.min : box.max, a);
        }
        enter = interval.enter;
        minusExit = -interval.exit;
        turn = 0;
    }
};

/// In which order a step visits its lanes, by what is swapped (bit 0: left and right, 1 and 2: those below
/// each) and which are entered: a byte for each, from the lowest on.
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

/// What a step enters, nearest first.
struct MvhStep {
    uint32_t count;
    uint32_t lanes;  // a byte for each: which grandchild, 0 to 3; without a second level 0 is the left child,
                     // 2 the right
    MvhPart parts[4];  // by lane

    uint32_t lane(uint32_t i) const { return lanes >> 8 * i & 3; }
};

#if defined(__SSE2__)

/// The vectors of a step.
struct MvhLanes {
    __m128 near[3], far[3], enter, minusExit;
    __m128i turn;

    BVHIO_INLINE MvhLanes(const MvhPart& part, float tLimit) {
        for (int a = 0; a < 3; ++a) {
            near[a] = _mm_set1_ps(part.near[a]);
            far[a] = _mm_set1_ps(part.far[a]);
        }
        enter = _mm_set1_ps(part.enter);
        minusExit = _mm_max_ps(_mm_set1_ps(part.minusExit), _mm_set1_ps(-tLimit));
        turn = _mm_set1_epi32(int(part.turn));
    }

    /// Goes from nodes to children: `low`, `swap` and `none` are the children's of MvhTables::Lanes. Returns
    /// all ones where the ray goes down the axis that is cut.
    BVHIO_INLINE __m128 descend(const MvhRay& ray, uint32_t axes, __m128 low, __m128 swap, __m128 none) {
        const __m128 sign = _mm_set1_ps(-0.0f), largest = _mm_set1_ps(std::numeric_limits<float>::max());
        const __m128i ones = _mm_set1_epi32(-1);
        __m128 sizes[3], lengths[3];
        for (int a = 0; a < 3; ++a) {
            sizes[a] = _mm_sub_ps(far[a], near[a]);
            lengths[a] = _mm_andnot_ps(sign, sizes[a]);
        }
        // An axis' place in the order is how many are longer; -1 is true.
        const __m128i y = _mm_castps_si128(_mm_cmpgt_ps(lengths[1], lengths[0])),
                      z = _mm_castps_si128(_mm_cmpgt_ps(lengths[2], lengths[0])),
                      zy = _mm_castps_si128(_mm_cmpgt_ps(lengths[2], lengths[1]));
        const __m128i minusTurn = _mm_sub_epi32(_mm_setzero_si128(), turn);
        const __m128i isX = _mm_cmpeq_epi32(_mm_add_epi32(y, z), minusTurn);
        const __m128i isY = _mm_cmpeq_epi32(_mm_add_epi32(_mm_xor_si128(y, ones), zy), minusTurn);
        const __m128 masks[3] = {_mm_castsi128_ps(isX), _mm_castsi128_ps(isY),
                                 _mm_castsi128_ps(_mm_xor_si128(_mm_or_si128(isX, isY), ones))};
        const auto select = [&](__m128 a, __m128 b, __m128 c) {
            return _mm_or_ps(_mm_or_ps(_mm_and_ps(masks[0], a), _mm_and_ps(masks[1], b)),
                             _mm_and_ps(masks[2], c));
        };
        const auto ofRay = [&](const auto& member) {
            const auto load = [&](int a) {
                return _mm_load_ps(reinterpret_cast<const float*>(ray.axes[a].*member));
            };
            return select(load(0), load(1), load(2));
        };
        const __m128 size =
            _mm_max_ps(_mm_min_ps(select(sizes[0], sizes[1], sizes[2]), largest), _mm_xor_ps(largest, sign));
        const __m128 backwards = ofRay(&MvhRay::Axis::backwards);
        const __m128 nearPart = _mm_xor_ps(low, _mm_and_ps(backwards, swap)),
                     farPart = _mm_xor_ps(nearPart, swap);
        const __m128 nearPlane = _mm_add_ps(select(near[0], near[1], near[2]), _mm_mul_ps(nearPart, size));
        const __m128 farPlane = _mm_sub_ps(select(far[0], far[1], far[2]), _mm_mul_ps(farPart, size));
        const __m128 origin = ofRay(&MvhRay::Axis::origin);
        // Of a NaN and a number the maximum is the second, the number, as in clipToPlanes. Where the ray
        // leaves is held with its sign swapped.
        enter = _mm_max_ps(_mm_mul_ps(_mm_sub_ps(nearPlane, origin), ofRay(&MvhRay::Axis::near)), enter);
        minusExit =
            _mm_max_ps(_mm_mul_ps(_mm_sub_ps(farPlane, origin), ofRay(&MvhRay::Axis::minusFar)), minusExit);
        for (int a = 0; a < 3; ++a) {
            near[a] = _mm_or_ps(_mm_and_ps(masks[a], nearPlane), _mm_andnot_ps(masks[a], near[a]));
            far[a] = _mm_or_ps(_mm_and_ps(masks[a], farPlane), _mm_andnot_ps(masks[a], far[a]));
        }
        const __m128i next = _mm_add_epi32(turn, _mm_set1_epi32(1));
        const __m128i wraps = _mm_cmpeq_epi32(next, _mm_set1_epi32(int(axes)));
        turn = _mm_and_si128(_mm_castps_si128(none), _mm_andnot_si128(wraps, next));
        return backwards;
    }

    /// Whether the lanes that `neighbours` holds are nearer than these. Builders put the lower child to the
    /// left, along the axis that is cut: that decides between equal ones.
    BVHIO_INLINE __m128 isAfter(__m128 neighbours, __m128 backwards) const {
        return _mm_or_ps(_mm_cmplt_ps(neighbours, enter),
                         _mm_and_ps(backwards, _mm_cmpeq_ps(neighbours, enter)));
    }
};

#else

/// The same for processors without such vectors.
struct MvhLanes {
    std::array<MvhPart, 4> parts;

    BVHIO_INLINE MvhLanes(const MvhPart& part, float tLimit) {
        parts.fill(part);
        for (MvhPart& p : parts) p.minusExit = p.minusExit > -tLimit ? p.minusExit : -tLimit;
    }

    /// Sends a lane's node to a child, `lane` of `to`. Returns whether the ray goes down the axis that is
    /// cut.
    template <size_t lanes>
    bool descend(MvhPart& part, const MvhRay& ray, uint32_t axes, const MvhTables::Lanes<lanes>& to,
                 size_t lane) {
        float sizes[3], lengths[3];
        for (int a = 0; a < 3; ++a) {
            sizes[a] = part.far[a] - part.near[a];
            lengths[a] = std::abs(sizes[a]);
        }
        const uint32_t y = lengths[1] > lengths[0], z = lengths[2] > lengths[0], zy = lengths[2] > lengths[1];
        const int axis = y + z == part.turn ? 0 : 1 - y + zy == part.turn ? 1 : 2;
        constexpr float kLargest = std::numeric_limits<float>::max();
        const float size = std::clamp(sizes[axis], -kLargest, kLargest);
        const MvhRay::Axis& of = ray.axes[axis];
        const bool backwards = of.backwards[0] != 0;
        const float low = to.low[lane],
                    high = std::bit_cast<float>(std::bit_cast<uint32_t>(low) ^ to.swap[lane]);
        part.near[axis] += (backwards ? high : low) * size;
        part.far[axis] -= (backwards ? low : high) * size;
        const float in = (part.near[axis] - of.origin[0]) * of.near[0],
                    out = (part.far[axis] - of.origin[0]) * of.minusFar[0];
        part.enter = in > part.enter ? in : part.enter;
        part.minusExit = out > part.minusExit ? out : part.minusExit;
        part.turn = to.none[lane] != 0 && part.turn + 1 < axes ? part.turn + 1 : 0;
        return backwards;
    }
    static bool isAfter(const MvhPart& one, const MvhPart& neighbour, bool backwards) {
        return neighbour.enter < one.enter || (backwards && neighbour.enter == one.enter);
    }
};

#endif

/// Tests the children of a node against the ray, and at once theirs where `twoLevels`. `codes` is the node's
/// nibble, and with two levels `leftCodes` and `rightCodes` are the children's, else 0. A child that is
/// missed has children that are missed.
#if defined(__SSE2__)
BVHIO_INLINE void stepMvh(const MvhTables& tables, const MvhRay& ray, uint32_t codes, uint32_t leftCodes,
                          uint32_t rightCodes, bool twoLevels, const MvhPart& part, float tLimit,
                          MvhStep& step) {
    MvhLanes lanes(part, tLimit);
    const auto load4 = [](const auto& values) {
        return _mm_load_ps(reinterpret_cast<const float*>(values.data()));
    };
    const MvhTables::Lanes<4>& first = tables.children[codes];
    __m128 backwards =
        lanes.descend(ray, tables.axes, load4(first.low), load4(first.swap), load4(first.none));
    const auto bits = [](__m128 v) { return uint32_t(_mm_movemask_ps(v)); };
    uint32_t swapped =
        bits(lanes.isAfter(_mm_shuffle_ps(lanes.enter, lanes.enter, _MM_SHUFFLE(1, 0, 3, 2)), backwards)) & 1;
    const auto load2 = [](const auto& left, const auto& right) {
        return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(left.data())),
                            reinterpret_cast<const __m64*>(right.data()));
    };
    if (twoLevels) {
        const MvhTables::Lanes<2>&left = tables.grandchildren[leftCodes],
              &right = tables.grandchildren[rightCodes];
        backwards = lanes.descend(ray, tables.axes, load2(left.low, right.low), load2(left.swap, right.swap),
                                  load2(left.none, right.none));
        const uint32_t below =
            bits(lanes.isAfter(_mm_shuffle_ps(lanes.enter, lanes.enter, _MM_SHUFFLE(2, 3, 0, 1)), backwards));
        swapped |= (below & 1) << 1 | (below & 4);
    }
    const __m128 exit = _mm_xor_ps(lanes.minusExit, _mm_set1_ps(-0.0f));
    const uint32_t entered = bits(_mm_cmple_ps(lanes.enter, exit)) & (twoLevels ? 15 : 5);
    step.count = uint32_t(std::popcount(entered));
    step.lanes = kMvhOrder.lanes[swapped][entered];
    _MM_TRANSPOSE4_PS(lanes.near[0], lanes.near[1], lanes.near[2], lanes.enter);
    _MM_TRANSPOSE4_PS(lanes.far[0], lanes.far[1], lanes.far[2], lanes.minusExit);
    const __m128 nearRows[4] = {lanes.near[0], lanes.near[1], lanes.near[2], lanes.enter};
    const __m128 farRows[4] = {lanes.far[0], lanes.far[1], lanes.far[2], lanes.minusExit};
    alignas(16) uint32_t turns[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(turns), lanes.turn);
    for (uint32_t i = 0; i < 4; ++i) {
        _mm_storeu_ps(step.parts[i].near, nearRows[i]);
        _mm_storeu_ps(step.parts[i].far, farRows[i]);
        step.parts[i].turn = turns[i];
    }
}
#else
BVHIO_INLINE void stepMvh(const MvhTables& tables, const MvhRay& ray, uint32_t codes, uint32_t leftCodes,
                          uint32_t rightCodes, bool twoLevels, const MvhPart& part, float tLimit,
                          MvhStep& step) {
    MvhLanes lanes(part, tLimit);
    bool backwards[4];
    for (size_t lane = 0; lane < 4; ++lane)
        backwards[lane] = lanes.descend(lanes.parts[lane], ray, tables.axes, tables.children[codes], lane);
    uint32_t swapped = MvhLanes::isAfter(lanes.parts[0], lanes.parts[2], backwards[0]);
    if (twoLevels) {
        for (size_t lane = 0; lane < 4; ++lane)
            backwards[lane] =
                lanes.descend(lanes.parts[lane], ray, tables.axes,
                              tables.grandchildren[lane < 2 ? leftCodes : rightCodes], lane % 2);
        for (const uint32_t child : {0, 1})
            swapped |= uint32_t(MvhLanes::isAfter(lanes.parts[2 * child], lanes.parts[2 * child + 1],
                                                  backwards[2 * child]))
                       << (1 + child);
    }
    uint32_t entered = 0;
    for (uint32_t lane = 0; lane < 4; ++lane)
        if (twoLevels || lane % 2 == 0)
            entered |= uint32_t(lanes.parts[lane].enter <= -lanes.parts[lane].minusExit) << lane;
    step.count = uint32_t(std::popcount(entered));
    step.lanes = kMvhOrder.lanes[swapped][entered];
    for (uint32_t i = 0; i < 4; ++i) step.parts[i] = lanes.parts[i];
}
#endif

}  // namespace bvhio
