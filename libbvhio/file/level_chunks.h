// The storage of each form as a level of the two-level form: format-spec/two-level.md.
#pragma once

#include <array>
#include <cstring>

#include "compress/two_level_form.h"
#include "file/chunks.h"
#include "file/quantized_chunks.h"
#include "file/ssh_chunks.h"

namespace bvhio {

/// The storage of a level. There is a specialisation for each form, with
///
/// - kCode: tlasForm or blasForm of FORM,
/// - kNodesChunk, kNodeSize: the chunk of its nodes, and the size of a node,
/// - write(writer, level): writes its chunks, the nodes last,
/// - read(chunks, counts): reads these. Throws FindingError if the level cannot be decoded. The decoded level
///   need not be valid.
template <class Level>
struct LevelChunks;

/// The counts and parameters of both levels in FORM.
struct LevelCounts {
    uint64_t references = 0, tlasSlots = 0, blases = 0, blasSlots = 0;
    bool areRuns = false;               // whether leaves of the top level own primitives, instead of a BLAS
    Aabb bounds{{0, 0, 0}, {0, 0, 0}};  // of a quantized top level's root
    uint32_t bits = 0;                  // of a quantized level
    uint32_t leafSize = 0;              // of mvh BLASes
};

/// Throws if a leaf of the top level does not refer to a BLAS, or to primitives.
inline void checkLeaf(const ChunkSequence& chunks, const std::string& name, PrimitiveRange leaf,
                      const LevelCounts& counts) {
    if (counts.areRuns ? uint64_t(leaf.first) + leaf.count > counts.references
                       : leaf.count != 1 || leaf.first >= counts.blases)
        chunks.fail(FindingId::leafRange,
                    name + " of the top level refers to " + std::to_string(leaf.count) +
                        (counts.areRuns ? " entries from " : " BLASes from ") + std::to_string(leaf.first) +
                        " on, but there are only " +
                        std::to_string(counts.areRuns ? counts.references : counts.blases));
}

/// Throws if children do not start at an index in (parent, slots).
inline void checkChildren(const ChunkSequence& chunks, const std::string& parent, int64_t index,
                          uint32_t children, uint64_t slots) {
    if (int64_t(children) <= index || children >= slots)
        chunks.fail(FindingId::childIndex, parent + " has its children at index " + std::to_string(children) +
                                               ", which is not after it and below " + std::to_string(slots));
}

inline std::string nodeName(size_t i) {
    return "node " + std::to_string(i);
}
inline std::string blasName(size_t i) {
    return "the root of BLAS " + std::to_string(i);
}

template <>
struct LevelChunks<AabbTlas> {
    static constexpr uint32_t kCode = chunkType("aabb");
    static constexpr uint32_t kNodesChunk = kTlasType;
    static constexpr size_t kNodeSize = sizeof(Node);

    static uint64_t nodesOffset(uint64_t payloadOffset) { return payloadOffset; }
    static void describe(const AabbTlas&, LevelCounts&) {}
    static uint64_t slots(const AabbTlas& tlas) { return tlas.form().bvh().nodes.size(); }
    static void write(ContainerWriter& writer, const AabbTlas& tlas) {
        writeArrayChunk(writer, kTlasType, tlas.form().bvh().nodes);
    }
    static AabbTlas read(ChunkSequence& chunks, const LevelCounts& counts) {
        auto nodes = chunks.expectArray<Node>(kTlasType, counts.tlasSlots);
        for (size_t i = 0; i < nodes.size(); ++i) {
            const Node& node = nodes[i];
            if (i == 1) {
                if (std::memcmp(&node, std::array<std::byte, sizeof node>{}.data(), sizeof node) != 0)
                    chunks.fail(FindingId::unusedSlot, "the unused slot 1 beside the root is not zero");
            } else if (!node.isLeaf()) {
                checkChildren(chunks, nodeName(i), int64_t(i), node.left(), nodes.size());
            } else {
                checkLeaf(chunks, nodeName(i), {node.first, node.primitiveCount}, counts);
            }
        }
        return AabbTlas(AabbForm({std::move(nodes), {}}));
    }
};

template <>
struct LevelChunks<QuantizedTlas> {
    using OfForm = FormChunks<QuantizedForm>;
    static constexpr uint32_t kCode = OfForm::kCode;
    static constexpr uint32_t kNodesChunk = kTlasType;
    static constexpr size_t kNodeSize = sizeof(QuantizedRecord) / 2;

    /// Node 2 r + 2 is the first half of record r: the root and its unused neighbour come before.
    static uint64_t nodesOffset(uint64_t payloadOffset) { return payloadOffset - 2 * kNodeSize; }
    static void describe(const QuantizedTlas& tlas, LevelCounts& counts) { counts.bounds = tlas.bounds(); }
    static uint64_t slots(const QuantizedTlas& tlas) { return 2 * tlas.form().records().size() + 2; }
    static void write(ContainerWriter& writer, const QuantizedTlas& tlas) {
        writeArrayChunk(writer, kTlasType, tlas.form().records());
    }
    static QuantizedTlas read(ChunkSequence& chunks, const LevelCounts& counts) {
        if (counts.references > QuantizedRecord::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "a quantized top level has at most 2^29 references");
        OfForm::checkBounds(chunks, counts.bounds);
        const size_t count = counts.tlasSlots / 2 - 1;
        if (count == 0 && counts.areRuns && counts.references > QuantizedRecord::kMaxLeafSize)
            chunks.fail(FindingId::treeCounts, "a leaf of a quantized top level has at most 128 references");
        auto records = chunks.expectArray<QuantizedRecord>(kTlasType, count);
        for (size_t i = 0; i < count; ++i) {
            OfForm::checkRecord(chunks, records[i], i, count, counts.bits);
            for (uint32_t child = 0; child < 2; ++child) {
                const uint32_t word = records[i].children[child];
                if (QuantizedRecord::isLeaf(word))
                    checkLeaf(chunks, nodeName(2 * i + 2 + child),
                              {QuantizedRecord::firstPrimitive(word),
                               QuantizedRecord::primitiveCount(word, records[i].highBits(child))},
                              counts);
            }
        }
        // A root that is a leaf owns everything.
        return QuantizedTlas(QuantizedForm(counts.bounds, counts.bits, std::move(records),
                                           std::vector<uint32_t>(count > 0        ? 0
                                                                 : counts.areRuns ? counts.references
                                                                                  : counts.blases)));
    }
};

template <>
struct LevelChunks<NibbleBlases> {
    static constexpr uint32_t kCode = chunkType("mvh ");
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = 0;  // nodes are not stored one by one

    static void write(ContainerWriter& writer, const NibbleBlases& blases) {
        writeArrayChunk(writer, kBlasType, blases.codes());
    }
    static NibbleBlases read(ChunkSequence& chunks, const LevelCounts& counts) {
        if (counts.references > NibbleRuns::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "mvh BLASes have at most 2^29 references");
        const size_t bytes = NibbleRuns(counts.leafSize).byteCount(counts.references);
        return {counts.leafSize, chunks.expectArray<uint8_t>(kBlasType, bytes)};
    }
};

template <>
struct LevelChunks<AabbBlases> {
    static constexpr uint32_t kCode = chunkType("aabb");
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = sizeof(Node);

    static void write(ContainerWriter& writer, const AabbBlases& blases) {
        writeArrayChunk(writer, kRootsType, blases.roots());
        writeArrayChunk(writer, kBlasType, blases.form().bvh().nodes);
    }
    static AabbBlases read(ChunkSequence& chunks, const LevelCounts& counts) {
        auto roots = chunks.expectArray<AabbBlases::Root>(kRootsType, counts.blases);
        for (size_t i = 0; i < roots.size(); ++i)
            if (roots[i].primitiveCount == 0)
                checkChildren(chunks, blasName(i), -1, roots[i].first, counts.blasSlots);
        auto nodes = chunks.expectArray<Node>(kBlasType, counts.blasSlots);
        for (size_t i = 0; i < nodes.size(); ++i)
            if (!nodes[i].isLeaf())
                checkChildren(chunks, nodeName(i), int64_t(i), nodes[i].left(), nodes.size());
        return {std::move(roots), AabbForm({std::move(nodes), {}})};
    }
};

template <>
struct LevelChunks<SshBlases> {
    static constexpr uint32_t kCode = chunkType("ssh ");
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = sizeof(SshNode);

    static void write(ContainerWriter& writer, const SshBlases& blases) {
        writeArrayChunk(writer, kRootsType, blases.roots());
        writeArrayChunk(writer, kBlasType, blases.form().nodes());
    }
    static SshBlases read(ChunkSequence& chunks, const LevelCounts& counts) {
        if (counts.references > SshNode::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "ssh BLASes have at most 2^25 references");
        auto roots = chunks.expectArray<uint32_t>(kRootsType, counts.blases);
        for (size_t i = 0; i < roots.size(); ++i)
            check(chunks, {0, roots[i]}, blasName(i), -1, counts.blasSlots);
        auto nodes = chunks.expectArray<SshNode>(kBlasType, counts.blasSlots);
        for (size_t i = 0; i < nodes.size(); ++i)
            check(chunks, nodes[i], nodeName(i), int64_t(i), nodes.size());
        return {std::move(roots), SshForm({}, std::move(nodes), {})};
    }

  private:
    static void check(const ChunkSequence& chunks, const SshNode& node, const std::string& name,
                      int64_t index, uint64_t slots) {
        if (node.side() > 5 || (index < 0 && node.side() != 0))
            chunks.fail(FindingId::nodeField,
                        name + " has side " + std::to_string(node.side()) + ", which is not allowed");
        if (!node.isLeaf()) checkChildren(chunks, name, index, node.left(), slots);
    }
};

template <>
struct LevelChunks<QuantizedBlases> {
    using OfForm = FormChunks<QuantizedForm>;
    static constexpr uint32_t kCode = OfForm::kCode;
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = sizeof(QuantizedRecord) / 2;

    static void write(ContainerWriter& writer, const QuantizedBlases& blases) {
        writeArrayChunk(writer, kRootsType, blases.roots());
        writeArrayChunk(writer, kBlasType, blases.form().records());
    }
    static QuantizedBlases read(ChunkSequence& chunks, const LevelCounts& counts) {
        if (counts.references > QuantizedRecord::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "quantized BLASes have at most 2^29 references");
        const size_t count = counts.blasSlots / 2;
        auto roots = chunks.expectArray<QuantizedRoot>(kRootsType, counts.blases);
        for (size_t i = 0; i < roots.size(); ++i) {
            const bool isLeaf = QuantizedRecord::isLeaf(roots[i].word);
            if (roots[i].highBits % 8 != 0 || roots[i].highBits > (isLeaf ? 0xFF : 0))
                chunks.fail(FindingId::nodeField,
                            blasName(i) + " has the value " + std::to_string(roots[i].highBits) +
                                " as the higher bits of a leaf's size, which is not allowed");
            if (!isLeaf && QuantizedRecord::record(roots[i].word) >= count)
                chunks.fail(FindingId::childIndex,
                            blasName(i) + " has its children in record " +
                                std::to_string(QuantizedRecord::record(roots[i].word)) +
                                ", but there are only " + std::to_string(count));
        }
        auto records = chunks.expectArray<QuantizedRecord>(kBlasType, count);
        for (size_t i = 0; i < count; ++i) OfForm::checkRecord(chunks, records[i], i, count, counts.bits);
        return {std::move(roots), QuantizedForm({}, counts.bits, std::move(records), {})};
    }
};

}  // namespace bvhio
