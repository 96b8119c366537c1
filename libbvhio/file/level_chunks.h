// How each form is stored as a level of the two-level form: format-spec/two-level.md.
#pragma once

#include <array>
#include <cstring>

#include "compress/two_level_form.h"
#include "file/chunks.h"
#include "file/ssh_chunks.h"

namespace bvhio {

/// How a level is stored: specialised for each, with
/// - kCode: FORM's tlasForm or blasForm,
/// - kNodesChunk, kNodeSize: what its nodes are,
/// - write(writer, level): its chunks, the nodes last,
/// - read(chunks, counts): reads those; throws FindingError unless the level can be decoded, be it to
/// nonsense.
template <class Level>
struct LevelChunks;

/// What FORM says of both levels.
struct LevelCounts {
    uint64_t references = 0, tlasSlots = 0, blases = 0, blasSlots = 0;
};

/// Throws unless children start at an index in (parent, slots).
inline void checkChildren(const ChunkSequence& chunks, const std::string& parent, int64_t index,
                          uint32_t children, uint64_t slots) {
    if (int64_t(children) <= index || children >= slots)
        chunks.fail(FindingId::childIndex, parent + " has its children at " + std::to_string(children) +
                                               ": not behind it and below " + std::to_string(slots));
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
            } else if (node.primitiveCount != 1 || node.first >= counts.blases) {
                chunks.fail(FindingId::leafRange, nodeName(i) + " of the top level names " +
                                                      std::to_string(node.primitiveCount) + " BLASes from " +
                                                      std::to_string(node.first) + " on: not one of " +
                                                      std::to_string(counts.blases));
            }
        }
        return AabbTlas(AabbForm({std::move(nodes), {}}));
    }
};

template <>
struct LevelChunks<AabbBlases> {
    static constexpr uint32_t kCode = chunkType("aabb");
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = sizeof(Node);

    static void write(ContainerWriter& writer, const AabbBlases& blases) {
        writeArrayChunk(writer, kRootsType, blases.roots());
        writeArrayChunk(writer, kBlasType, blases.nodes());
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
        return {std::move(roots), std::move(nodes)};
    }
};

template <>
struct LevelChunks<SshBlases> {
    static constexpr uint32_t kCode = chunkType("ssh ");
    static constexpr uint32_t kNodesChunk = kBlasType;
    static constexpr size_t kNodeSize = sizeof(SshNode);

    static void write(ContainerWriter& writer, const SshBlases& blases) {
        writeArrayChunk(writer, kRootsType, blases.roots());
        writeArrayChunk(writer, kBlasType, blases.nodes());
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
        return {std::move(roots), std::move(nodes)};
    }

  private:
    static void check(const ChunkSequence& chunks, const SshNode& node, const std::string& name,
                      int64_t index, uint64_t slots) {
        if (node.side() > 5 || (index < 0 && node.side() != 0))
            chunks.fail(FindingId::nodeField, name + " names side " + std::to_string(node.side()));
        if (!node.isLeaf()) checkChildren(chunks, name, index, node.left(), slots);
    }
};

}  // namespace bvhio
