// The core of the mvh form: the shape of a Minimal BVH, its codes, and the cuts that they stand for.
//
// P. Bauszat, M. Eisemann, M. Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010. The tree is complete
// and its nodes are implicit: node i has the children 2 i + 1 and 2 i + 2. A code of two bits per node gives
// its box from its parent's: along the longest axis of the parent's box, it moves the low plane inwards, the
// high plane, both or neither, each by a fixed part of the box's size: zeta.
//
// Departures: a cut of both planes has a zeta of its own. Below a node that could not be cut, the next
// longest axis has its turn; the paper tries the longest again and again (architecture: -40% SAH cost).
// Leaves lie in the primitive array from left to right, so that a subtree owns one run of it. The last leaf
// is short; the paper stores triangles twice instead.
//
// Many trees can share one array of codes and one of primitives. A tree over the run [first, first + count)
// of primitives has the nibbles from mvhFirstNibble(first, n) on. The i-th of them is node i's, with its left
// child's code in the two low bits and its right child's in the two high bits. The nibbles of trees never
// overlap: with leaves of n primitives, a tree has ceil(count / n) - 1 inner nodes, and
//     ceil(count / n) - 1 <= floor(count / n) <= ceil((first + count) / n) - ceil(first / n).
// So all trees over P primitives together need ceil(P / n) nibbles and no table.
#pragma once

#include <bit>
#include <cstring>

#include "compress/form_concept.h"

namespace bvhio {

/// How far codes cut, and along which axes.
struct MvhRule {
    static constexpr float kMaxZeta = 0.99f, kMaxZetaOfBoth = 0.5f;

    // How far a cut moves a plane, as a part of the box's size: if it moves one plane, and if it moves both.
    float zeta = 0.45f, zetaOfBoth = 0.3f;
    uint32_t axes = 3;  // how many axes take turns if nodes cannot be cut; 1: always the longest
    bool operator==(const MvhRule&) const = default;
};

struct MvhParameters {
    static constexpr uint32_t kMaxLeafSize = 16;

    uint32_t leafSize = 4;
    MvhRule rule;
    bool operator==(const MvhParameters&) const = default;
};

/// How the mvh form divides triangles: with much choice, as its paper does (compress/mvh_build.h), or as the
/// given tree does, if that has the form's shape; others count as best.
enum class MvhBuild : uint8_t { best, paper, given };

/// A node's box as reconstructed, and which axis its children are cut along: 0 the longest, 1 the second, 2
/// the shortest. The root's turn is 0.
struct MvhBox {
    Aabb bounds;
    uint32_t turn = 0;
};

/// The shape of a tree over `count` primitives, 1 at least, in leaves of `leafSize`.
class MvhShape {
  public:
    BVHIO_INLINE MvhShape(uint32_t count, uint32_t leafSize)
        : count_(count), leafSize_(leafSize), leaves_((count + leafSize - 1) / leafSize) {}

    uint32_t primitiveCount() const { return count_; }
    uint32_t leafCount() const { return leaves_; }
    uint32_t nodeCount() const { return 2 * leaves_ - 1; }
    /// Returns the number of inner nodes, which come before all leaves.
    uint32_t innerCount() const { return leaves_ - 1; }
    BVHIO_INLINE bool isLeaf(uint32_t node) const { return node >= leaves_ - 1; }
    /// Returns a leaf's primitives, counted from the tree's first. The last leaf has the rest.
    BVHIO_INLINE PrimitiveRange primitiveRange(uint32_t leaf) const {
        const uint32_t lowest = std::bit_ceil(leaves_) - 1;  // the first node of the deepest level
        const uint32_t first = (leaf >= lowest ? leaf - lowest : leaf - lowest + leaves_) * leafSize_;
        return {first, first + leafSize_ <= count_ ? leafSize_ : count_ - first};
    }
    /// Returns the number of edges from the root to the deepest leaf.
    uint32_t depth() const { return uint32_t(std::bit_width(leaves_ - 1)); }
    /// Returns how many of the `count` primitives under an inner node are under its left
    /// child.
    static uint32_t leftCount(uint32_t count, uint32_t leafSize) {
        const uint32_t leaves = (count + leafSize - 1) / leafSize;
        const uint32_t half = std::bit_ceil(leaves) / 2, deepest = 2 * (leaves - half);
        return (half + (deepest < half ? deepest : half)) / 2 * leafSize;
    }

  private:
    uint32_t count_, leafSize_, leaves_;
};

/// Returns the root's nibble of the tree over primitives from `first` on, in an array that trees share.
BVHIO_INLINE uint32_t mvhFirstNibble(uint32_t first, uint32_t leafSize) {
    return (first + leafSize - 1) / leafSize;
}
/// Returns one nibble of an array of 32-bit words: the codes of a node's children.
BVHIO_INLINE uint32_t mvhNibble(const uint32_t* words, size_t nibble) {
    uint8_t byte;  // a step needs only one byte, not the whole word
    std::memcpy(&byte, reinterpret_cast<const char*>(words) + nibble / 2, 1);
    return uint32_t(byte) >> nibble % 2 * 4 & 15u;
}

enum MvhCode : uint32_t { kMvhNone = 0, kMvhLow = 1, kMvhHigh = 2, kMvhBoth = 3 };

/// The planes of two children along the axis that is cut, by their codes. Builders, the decoder and rays all
/// use this arithmetic, which format-spec/mvh.md fixes. Of equally long axes, the first counts as the
/// longest.
struct MvhCuts {
    uint32_t axis;
    uint32_t turnOfNone;  // the turn of a child with code none; others have turn 0
    float low[4], high[4];

    BVHIO_INLINE MvhCuts(const MvhBox& parent, const MvhRule& rule) {
        const Aabb& box = parent.bounds;
        const float sizes[3] = {box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z};
        const uint32_t y = sizes[1] > sizes[0], z = sizes[2] > sizes[0], zy = sizes[2] > sizes[1];
        axis = y + z == parent.turn ? 0 : 1 - y + zy == parent.turn ? 1 : 2;
        turnOfNone = parent.turn + 1 < rule.axes ? parent.turn + 1 : 0;
        constexpr float kLargest = std::numeric_limits<float>::max();
        const float size = sizes[axis] < kLargest ? sizes[axis] : kLargest;
        const float one = rule.zeta * size, both = rule.zetaOfBoth * size;
        const float min = component(box.min, int(axis)), max = component(box.max, int(axis));
        low[kMvhNone] = low[kMvhHigh] = min;
        high[kMvhNone] = high[kMvhLow] = max;
        low[kMvhLow] = min + one;
        low[kMvhBoth] = min + both;
        high[kMvhHigh] = max - one;
        high[kMvhBoth] = max - both;
    }

    BVHIO_INLINE MvhBox child(const MvhBox& parent, uint32_t code) const {
        MvhBox box{parent.bounds, code == kMvhNone ? turnOfNone : 0};
        (&box.bounds.min.x)[axis] = low[code];
        (&box.bounds.max.x)[axis] = high[code];
        return box;
    }
    /// Returns the code that shrinks the parent's box most, but still holds `tight`, which lies in that box.
    uint32_t code(const Aabb& tight) const {
        const float min = component(tight.min, int(axis)), max = component(tight.max, int(axis));
        uint32_t best = kMvhNone;
        for (const uint32_t code : {kMvhLow, kMvhHigh, kMvhBoth})
            if (low[code] <= min && high[code] >= max && high[code] - low[code] < high[best] - low[best])
                best = code;
        return best;
    }
};

}  // namespace bvhio
