// The header and the streams of chunk TOPO, for its writer and its reader.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tree/bvh.h"

namespace bvhio {

/// The head of the payload.
struct TopologyHeader {
    uint32_t order = 0;          // of pairs: kDepthFirst or kListed
    uint32_t ranges = 0;         // of leaves: kDepthFirst or kListed
    uint32_t leafSizeBytes = 0;  // bytes that store a leaf's size minus 1
    uint64_t boxes = 0;          // that differ from those of a refit
    uint64_t planes = 0;         // of those boxes
};

inline constexpr uint32_t kDepthFirst = 0, kListed = 1;
inline constexpr size_t kTopologyHeaderSize = 64;

/// The bytes of each stream after the header, in file order.
struct TopologySizes {
    uint64_t innerBits, parents, ranges, leafSizes, boxBits, boxSides, planes;

    /// Computes the sizes for a tree with `slots` node slots, an even number of at least 2.
    TopologySizes(const TopologyHeader& header, uint64_t slots)
        : innerBits((slots + 7) / 8),
          parents(header.order == kListed ? 4 * (slots / 2 - 1) : 0),
          ranges(header.ranges == kListed ? 4 * (slots / 2) : 0),
          leafSizes(header.leafSizeBytes * (slots / 2)),
          boxBits(header.boxes > 0 ? (slots + 7) / 8 : 0),
          boxSides(header.boxes),
          planes(4 * header.planes) {}
    uint64_t total() const {
        return kTopologyHeaderSize + innerBits + parents + ranges + leafSizes + boxBits + boxSides + planes;
    }
};

/// Returns for each node of a tree whose children come after their parents the start of its leaves' ranges,
/// if the ranges follow each other in a depth-first walk, left children first.
inline std::vector<uint32_t> depthFirstRanges(std::span<const Node> nodes) {
    std::vector<uint32_t> counts(nodes.size()), firsts(nodes.size());
    for (size_t i = nodes.size(); i-- > 0;)
        counts[i] = nodes[i].isLeaf() || i == 1 ? nodes[i].primitiveCount
                                                : counts[nodes[i].left()] + counts[nodes[i].right()];
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].isLeaf() || i == 1) continue;
        firsts[nodes[i].left()] = firsts[i];
        firsts[nodes[i].right()] = firsts[i] + counts[nodes[i].left()];
    }
    return firsts;
}

/// Returns a plane of a box. The planes are min x, y, z, then max x, y, z.
inline float& planeOf(Aabb& box, uint32_t side) {
    return side < 3 ? box.min[int(side)] : box.max[int(side) - 3];
}

/// Maps signed numbers to unsigned ones, and small ones to small ones: 0, -1, 1, -2 become 0, 1, 2, 3. Modulo
/// 2^32.
constexpr uint32_t zigzag(uint32_t number) {
    return number << 1 ^ (number >> 31 != 0 ? ~0u : 0);
}
constexpr uint32_t fromZigzag(uint32_t code) {
    return code >> 1 ^ ((code & 1) != 0 ? ~0u : 0);
}

}  // namespace bvhio
