// The storage of the ssh form: format-spec/ssh.md.
#pragma once

#include <bit>

#include "compress/ssh_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<SshForm> {
    static constexpr uint32_t kCode = chunkType("ssh ");
    static constexpr size_t kFormSize = 64;

    static TreeParameters parameters(const SshForm& form) {
        return {kCode, form.nodes().size(), form.primitives().size(), {}, depthOf(form.decode())};
    }
    static void write(ContainerWriter& writer, const SshForm& form) {
        ByteWriter bytes;
        writeBox(bytes, form.bounds());
        bytes.zeros(kFormSize - bytes.bytes().size());
        writeChunk(writer, kFormType, bytes.bytes());
        writeArrayChunk(writer, kNodesType, form.nodes());
        writeArrayChunk(writer, kPrimitivesType, form.primitives());
    }
    static SshForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        if (parameters.references > SshNode::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "an ssh tree has at most 2^25 references");
        const Bytes payload = chunks.expect(kFormType, kFormSize);
        ByteReader reader(payload, "chunk FORM");
        const Aabb bounds = readBox(reader);
        if (!reader.skipZeros(reader.remaining()))
            chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        SharedArray<SshNode> nodes = chunks.expectArray<SshNode>(kNodesType, parameters.nodeSlots);
        for (size_t i = 0; i < nodes.size(); ++i) checkNode(chunks, nodes, i);
        const uint64_t nodesOffset = chunks.payloadOffset();
        SshForm form(bounds, std::move(nodes),
                     chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references));
        validateForm(chunks, form, parameters, scene, nodesOffset, sizeof(SshNode));
        return form;
    }

  private:
    /// Checks what decoding relies on. The decoded tree may still be invalid.
    static void checkNode(const ChunkSequence& chunks, std::span<const SshNode> nodes, size_t i) {
        const SshNode& node = nodes[i];
        if (i == 1) {
            if (std::bit_cast<uint64_t>(node) != 0)
                chunks.fail(FindingId::unusedSlot, "the unused slot 1 beside the root is not zero");
        } else if (node.side() > 5) {
            chunks.fail(FindingId::nodeField, "node " + std::to_string(i) + " changes side " +
                                                  std::to_string(node.side()) +
                                                  ", but a box has only sides 0 to 5");
        } else if (!node.isLeaf() && (node.left() <= i || node.left() >= nodes.size())) {
            chunks.fail(FindingId::childIndex, "node " + std::to_string(i) + " has its children at index " +
                                                   std::to_string(node.left()) +
                                                   ", which is not after it and below " +
                                                   std::to_string(nodes.size()));
        }
    }
};

}  // namespace bvhio
