#include <bit>

#include "core/bytes.h"
#include "file/topology.h"
#include "file/topology_format.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

using ByteString = std::vector<std::byte>;

void setBit(ByteString& bits, size_t i) {
    bits[i / 8] |= std::byte(1u << i % 8);
}

/// Appends the lowest byte of each number, then the second byte of each, and so on. High bytes are mostly
/// equal, and compress well.
void appendBytePlanes(ByteString& bytes, std::span<const uint32_t> numbers, uint32_t planes) {
    for (uint32_t plane = 0; plane < planes; ++plane)
        for (const uint32_t number : numbers) bytes.push_back(std::byte(number >> 8 * plane));
}

/// Returns the distance of each pair from its parent before it; nothing if pairs are in depth-first order.
std::vector<uint32_t> parentDistances(std::span<const Node> nodes) {
    std::vector<uint32_t> distances(nodes.size() / 2 - 1), waiting;
    bool depthFirst = true;
    if (!nodes[0].isLeaf()) waiting.push_back(0);
    for (uint32_t left = 2; left < nodes.size(); left += 2) {
        // In another order the stack of waiting nodes soon becomes wrong, and is not used any more.
        if (depthFirst) {
            depthFirst = nodes[waiting.back()].left() == left;
            waiting.pop_back();
        }
        for (const uint32_t child : {left + 1, left})
            if (depthFirst && !nodes[child].isLeaf()) waiting.push_back(child);
    }
    if (depthFirst) return {};
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (i != 1 && !nodes[i].isLeaf()) distances[nodes[i].left() / 2 - 1] = nodes[i].left() - i;
    return distances;
}

/// Returns the difference between the start of each leaf's range and its start in a depth-first walk; nothing
/// if all are 0.
std::vector<uint32_t> rangeDifferences(std::span<const Node> nodes) {
    const std::vector<uint32_t> firsts = depthFirstRanges(nodes);
    std::vector<uint32_t> differences;
    bool differ = false;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].isLeaf()) continue;
        differences.push_back(zigzag(nodes[i].first - firsts[i]));
        differ |= differences.back() != 0;
    }
    return differ ? differences : std::vector<uint32_t>();
}

/// The boxes that differ from those of a refit.
struct StoredBoxes {
    ByteString bits, sides;
    std::array<std::vector<uint32_t>, 6> planes;

    StoredBoxes(std::span<const Node> nodes, std::span<const uint32_t> primitives,
                const PrimitiveBounds& primitiveBounds)
        : bits((nodes.size() + 7) / 8) {
        AlignedVector<Node> fitted(nodes.begin(), nodes.end());
        fitLeaves(fitted, primitives, primitiveBounds);
        for (size_t i = 0; i < nodes.size(); ++i)
            if (i != 1)
                compare(i, nodes[i].bounds,
                        nodes[i].isLeaf()
                            ? fitted[i].bounds
                            : unite(nodes[nodes[i].left()].bounds, nodes[nodes[i].right()].bounds));
        if (sides.empty()) bits.clear();
    }

  private:
    void compare(size_t node, Aabb box, Aabb fitted) {
        uint32_t different = 0;
        for (uint32_t side = 0; side < 6; ++side) {
            const auto plane = std::bit_cast<uint32_t>(planeOf(box, side));
            if (plane == std::bit_cast<uint32_t>(planeOf(fitted, side))) continue;
            different |= 1u << side;
            planes[side].push_back(plane);
        }
        if (different == 0) return;
        setBit(bits, node);
        sides.push_back(std::byte(different));
    }
};

}  // namespace

std::vector<std::byte> topologyPayload(const Bvh& bvh, const PrimitiveBounds& primitiveBounds) {
    const std::span<const Node> nodes = bvh.nodes;
    ByteString innerBits((nodes.size() + 7) / 8);
    std::vector<uint32_t> leafSizes;
    uint32_t largest = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (i == 1) continue;
        if (nodes[i].isLeaf()) {
            leafSizes.push_back(nodes[i].primitiveCount - 1);
            largest = std::max(largest, leafSizes.back());
        } else {
            setBit(innerBits, i);
        }
    }
    const std::vector<uint32_t> distances = parentDistances(nodes), differences = rangeDifferences(nodes);
    const StoredBoxes boxes(nodes, bvh.primitives, primitiveBounds);
    const uint32_t leafSizeBytes = largest > 255 ? 2 : largest > 0 ? 1 : 0;
    std::vector<uint32_t> planes;
    for (const auto& side : boxes.planes) planes.insert(planes.end(), side.begin(), side.end());

    ByteWriter header;
    header.u32(distances.empty() ? kDepthFirst : kListed);
    header.u32(differences.empty() ? kDepthFirst : kListed);
    header.u32(leafSizeBytes);
    header.u32(0);
    header.u64(boxes.sides.size());
    header.u64(planes.size());
    header.zeros(kTopologyHeaderSize - header.bytes().size());
    ByteString payload(header.bytes().begin(), header.bytes().end());
    const auto append = [&](std::span<const std::byte> bytes) {
        payload.insert(payload.end(), bytes.begin(), bytes.end());
    };
    append(innerBits);
    appendBytePlanes(payload, distances, 4);
    appendBytePlanes(payload, differences, 4);
    appendBytePlanes(payload, leafSizes, leafSizeBytes);
    append(boxes.bits);
    append(boxes.sides);
    append(std::as_bytes(std::span(planes)));
    return payload;
}

}  // namespace bvhio
