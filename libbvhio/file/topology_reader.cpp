#include <algorithm>
#include <bit>
#include <cstring>

#include "core/buffer.h"
#include "core/bytes.h"
#include "file/topology.h"
#include "file/topology_format.h"
#include "scene/triangle_bounds.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

using ByteSpan = std::span<const std::byte>;

bool bitOf(ByteSpan bits, size_t i) {
    return (uint32_t(bits[i / 8]) >> i % 8 & 1) != 0;
}

/// Returns number i of `count` numbers whose bytes are stored in planes.
uint32_t numberOf(ByteSpan bytes, size_t count, uint32_t planes, size_t i) {
    uint32_t number = 0;
    for (uint32_t plane = 0; plane < planes; ++plane)
        number |= uint32_t(bytes[plane * count + i]) << 8 * plane;
    return number;
}

class TopologyReader {
  public:
    TopologyReader(ChunkSequence& chunks, const TreeParameters& parameters)
        : chunks_(chunks),
          slots_(parameters.nodeSlots),
          references_(parameters.references),
          payload_(chunks.expect(kTopologyType, ChunkSequence::kAnySize)) {}

    Bvh read(const SharedArray<uint32_t>& primitives, const Scene& scene) {
        readStreams();
        nodes_ = Buffer<Node>(slots_);
        for (size_t i = 0; i < slots_; ++i) nodes_[i] = {};
        placePairs();
        readLeaves();
        if (chunks_.sound()) fitBoxes(primitives, scene);
        return {std::move(nodes_).share(), primitives};
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { chunks_.fail(FindingId::topology, message); }
    bool isInner(size_t node) const { return bitOf(innerBits_, node); }
    std::span<Node> nodes() { return {nodes_.data(), nodes_.size()}; }

    /// Reads the header and finds each stream. No memory is allocated before the payload is known to have the
    /// promised size.
    void readStreams() {
        if (payload_.size() < kTopologyHeaderSize)
            chunks_.fail(FindingId::chunkSize, "the payload is shorter than its header");
        ByteReader reader(payload_, "chunk TOPO");
        header_.order = reader.u32();
        header_.ranges = reader.u32();
        header_.leafSizeBytes = reader.u32();
        bool zero = reader.skipZeros(4);
        header_.boxes = reader.u64();
        header_.planes = reader.u64();
        zero &= reader.skipZeros(kTopologyHeaderSize - reader.position());
        if (!zero) chunks_.fail(FindingId::payloadReserved, "a reserved field is not zero");
        if (header_.order > kListed || header_.ranges > kListed || header_.leafSizeBytes > 2 ||
            header_.boxes >= slots_ || header_.planes > 6 * header_.boxes)
            fail("a field of the header is out of its range");
        const TopologySizes sizes(header_, slots_);
        if (sizes.total() != payload_.size())
            chunks_.fail(FindingId::chunkSize, "the payload has " + std::to_string(payload_.size()) +
                                                   " bytes, but the counts require " +
                                                   std::to_string(sizes.total()));
        innerBits_ = reader.bytes(sizes.innerBits);
        parents_ = reader.bytes(sizes.parents);
        ranges_ = reader.bytes(sizes.ranges);
        leafSizes_ = reader.bytes(sizes.leafSizes);
        boxBits_ = reader.bytes(sizes.boxBits);
        boxSides_ = reader.bytes(sizes.boxSides);
        planes_ = reader.bytes(sizes.planes);
        if (countBits(innerBits_) != slots_ / 2 - 1)
            fail(std::to_string(countBits(innerBits_)) + " inner nodes cannot form a tree of " +
                 std::to_string(slots_) + " node slots");
        if (header_.boxes > 0 && countBits(boxBits_) != header_.boxes)
            fail("the number of set bits differs from the number of stored boxes");
    }

    /// Returns the number of set bits. The bits of slot 1 and after the last slot are reserved.
    uint64_t countBits(ByteSpan bits) const {
        if (bitOf(bits, 1) || (slots_ % 8 != 0 && uint32_t(bits.back()) >> slots_ % 8 != 0))
            chunks_.fail(FindingId::payloadReserved, "a reserved bit is not zero");
        uint64_t count = 0;
        for (const std::byte b : bits) count += uint64_t(std::popcount(uint8_t(b)));
        return count;
    }

    /// Assigns each pair to its parent. There are as many pairs as inner nodes, so each inner node gets one.
    void placePairs() {
        const size_t pairs = slots_ / 2;
        std::vector<uint8_t> depths(pairs);  // of the nodes of each pair
        std::vector<uint32_t> waiting;       // inner nodes that wait for their children, the next one last
        if (isInner(0)) waiting.push_back(0);
        for (size_t pair = 1; pair < pairs; ++pair) {
            const auto left = uint32_t(2 * pair);
            uint32_t parent = 0;
            if (header_.order == kListed) {
                const uint32_t distance = numberOf(parents_, pairs - 1, 4, pair - 1);
                if (distance == 0 || distance > left || !isInner(left - distance))
                    fail("node " + std::to_string(left) + " is not a child of an inner node before it");
                parent = left - distance;
                if (nodes_[parent].first != 0)
                    fail("node " + std::to_string(parent) + " has two pairs of children");
            } else {
                if (waiting.empty()) fail("node " + std::to_string(left) + " comes after the tree's last");
                parent = waiting.back();
                waiting.pop_back();
                for (const uint32_t child : {left + 1, left})
                    if (isInner(child)) waiting.push_back(child);
            }
            nodes_[parent].first = left;
            depths[pair] = uint8_t(depths[parent / 2] + 1);
            if (depths[pair] > kMaxDepth)
                chunks_.fail(FindingId::depth, "node " + std::to_string(left) + " is more than " +
                                                   std::to_string(kMaxDepth) + " edges below the root");
        }
    }

    void readLeaves() {
        const size_t leaves = slots_ / 2;
        uint64_t sum = 0;
        for (size_t i = 0, leaf = 0; i < slots_; ++i) {
            if (i == 1 || isInner(i)) continue;
            const uint32_t size = numberOf(leafSizes_, leaves, header_.leafSizeBytes, leaf++) + 1;
            if (size > kMaxLeafSize)
                chunks_.fail(FindingId::leafRange, "leaf " + std::to_string(i) + " has " +
                                                       std::to_string(size) + " primitives, but at most " +
                                                       std::to_string(kMaxLeafSize) + " are allowed");
            nodes_[i].primitiveCount = size;
            sum += size;
        }
        if (sum != references_)
            chunks_.fail(FindingId::leafCover, "the leaves have " + std::to_string(sum) +
                                                   " primitives, but the tree has " +
                                                   std::to_string(references_));
        const std::vector<uint32_t> firsts = depthFirstRanges(nodes());
        for (size_t i = 0, leaf = 0; i < slots_; ++i) {
            Node& node = nodes_[i];
            if (!node.isLeaf()) continue;
            node.first = firsts[i];
            if (header_.ranges == kListed) node.first += fromZigzag(numberOf(ranges_, leaves, 4, leaf++));
            if (node.first > references_ - node.primitiveCount)
                chunks_.fail(FindingId::leafRange,
                             "the range of leaf " + std::to_string(i) + " exceeds the array of primitives");
        }
    }

    /// Computes the boxes bottom-up, and so goes through the stored boxes from the last to the first.
    void fitBoxes(std::span<const uint32_t> primitives, const Scene& scene) {
        std::array<uint64_t, 6> ends{};  // of each side's planes
        for (const std::byte sides : boxSides_) {
            if (sides == std::byte{0} || uint32_t(sides) > 63)
                fail("a stored box has no side, or a side that does not exist");
            for (uint32_t side = 0; side < 6; ++side) ends[side] += uint32_t(sides) >> side & 1;
        }
        for (uint32_t side = 1; side < 6; ++side) ends[side] += ends[side - 1];
        if (ends[5] != header_.planes)
            fail("the number of stored planes differs from that of the stored boxes");

        fitLeaves(nodes(), primitives, boundsOfTriangles(scene));
        size_t box = header_.boxes;
        for (size_t i = slots_; i-- > 0;) {
            if (i == 1) continue;
            Node& node = nodes_[i];
            if (!node.isLeaf()) node.bounds = unite(nodes_[node.left()].bounds, nodes_[node.right()].bounds);
            if (header_.boxes == 0 || !bitOf(boxBits_, i)) continue;
            const auto sides = uint32_t(boxSides_[--box]);
            for (uint32_t side = 0; side < 6; ++side)
                if ((sides >> side & 1) != 0)
                    std::memcpy(&planeOf(node.bounds, side), &planes_[4 * --ends[side]], sizeof(float));
        }
    }

    ChunkSequence& chunks_;
    const size_t slots_;
    const uint64_t references_;
    const Bytes payload_;
    TopologyHeader header_;
    ByteSpan innerBits_, parents_, ranges_, leafSizes_, boxBits_, boxSides_, planes_;
    Buffer<Node> nodes_;
};

}  // namespace

Bvh readTopology(ChunkSequence& chunks, const TreeParameters& parameters,
                 const SharedArray<uint32_t>& primitives, const Scene& scene) {
    return TopologyReader(chunks, parameters).read(primitives, scene);
}

}  // namespace bvhio
