// The core of the mvh form: one Minimal BVH, its shape, its cuts and how a ray steps through it.
//
// P. Bauszat, M. Eisemann, M. Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010. The tree is complete
// and its nodes are implicit: node i has the children 2 i + 1 and 2 i + 2, and a code of two bits, by which
// its box follows from its parent's. Along the longest axis of the parent's box a code moves the low plane
// inwards, the high plane, both or neither, each by a fixed part of the box's size: zeta.
//
// Departures: a cut of both planes has a zeta of its own. Below a node that could not be cut the next longest
// axis has its turn, where the paper tries the longest again and again (architecture: -40% SAH cost). Leaves
// lie in the primitive array from left to right, so that a subtree owns one run of it. The last leaf is
// short, where the paper stores triangles twice.
//
// Many trees can share one array of codes and one of primitives. A tree over the run [first, first + count)
// of primitives has the nibbles from mvhFirstNibble(first, n) on: node i's is the i-th of them, its left
// child's code in the two low bits, its right child's in the two high ones. These never overlap: with leaves
// of n primitives a tree has ceil(count / n) - 1 inner nodes, and
//     ceil(count / n) - 1 <= floor(count / n) <= ceil((first + count) / n) - ceil(first / n).
// So all trees over P primitives together need ceil(P / n) nibbles and no table.
#pragma once

#include <bit>
#include <cstring>

#include "compress/form_concept.h"

namespace bvhio {

/// How codes cut.
struct MvhRule {
    static constexpr float kMaxZeta = 0.99f, kMaxZetaOfBoth = 0.5f;

    float zeta = 0.45f,
          zetaOfBoth = 0.3f;  // the part of a box's size that a cut of one plane takes, and each of two
    uint32_t axes = 3;        // how many axes take turns where nodes cannot be cut; 1: always the longest
    bool operator==(const MvhRule&) const = default;
};

struct MvhParameters {
    static constexpr uint32_t kMaxLeafSize = 16;

    uint32_t leafSize = 4;
    MvhRule rule;
    bool operator==(const MvhParameters&) const = default;
};

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
    /// Nodes below this are inner ones.
    uint32_t innerCount() const { return leaves_ - 1; }
    BVHIO_INLINE bool isLeaf(uint32_t node) const { return node >= leaves_ - 1; }
    /// A leaf's primitives, counted from the tree's first. The last leaf has what is left.
    BVHIO_INLINE PrimitiveRange primitiveRange(uint32_t leaf) const {
        const uint32_t lowest = std::bit_ceil(leaves_) - 1;  // the first node of the deepest level
        const uint32_t first = (leaf >= lowest ? leaf - lowest : leaf - lowest + leaves_) * leafSize_;
        return {first, first + leafSize_ <= count_ ? leafSize_ : count_ - first};
    }
    /// Edges from the root to the deepest leaf.
    uint32_t depth() const { return uint32_t(std::bit_width(leaves_ - 1)); }
    /// How many of the primitives under an inner node are under its left child, where `count` of them are
    /// under the node.
    static uint32_t leftCount(uint32_t count, uint32_t leafSize) {
        const uint32_t leaves = (count + leafSize - 1) / leafSize;
        const uint32_t half = std::bit_ceil(leaves) / 2, deepest = 2 * (leaves - half);
        return (half + (deepest < half ? deepest : half)) / 2 * leafSize;
    }

  private:
    uint32_t count_, leafSize_, leaves_;
};

/// The nibble of the root of the tree over primitives from `first` on, in an array that trees share.
BVHIO_INLINE uint32_t mvhFirstNibble(uint32_t first, uint32_t leafSize) {
    return (first + leafSize - 1) / leafSize;
}
/// One nibble of an array of 32-bit words: the codes of a node's children.
BVHIO_INLINE uint32_t mvhNibble(const uint32_t* words, size_t nibble) {
    uint8_t byte;  // one byte, not its word: a step needs no more
    std::memcpy(&byte, reinterpret_cast<const char*>(words) + nibble / 2, 1);
    return uint32_t(byte) >> nibble % 2 * 4 & 15u;
}

enum MvhCode : uint32_t { kMvhNone = 0, kMvhLow = 1, kMvhHigh = 2, kMvhBoth = 3 };

/// Where the planes of two children are along the axis that is cut, by their codes: the arithmetic that
/// format-spec/mvh.md pins, for builders, decoder and rays alike. Of equally long axes the first is the
/// longer.
struct MvhCuts {
    uint32_t axis;
    uint32_t turnOfNone;  // of a child with that code; of others it is 0
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
    /// The code that leaves the least of the parent's box that still holds `tight`, which the parent's does.
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
