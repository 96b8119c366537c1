// How the aabb form is stored: format-spec/aabb.md.
#pragma once

#include "compress/aabb_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<AabbForm> {
    static constexpr uint32_t kCode = chunkType("aabb");

    static TreeParameters parameters(const AabbForm& form) {
        return {kCode, form.bvh().nodes.size(), form.primitives().size(), {}, depthOf(form.bvh())};
    }
    static void write(ContainerWriter& writer, const AabbForm& form) {
        writeArrayChunk(writer, kNodesType, form.bvh().nodes);
        writeArrayChunk(writer, kPrimitivesType, form.bvh().primitives);
    }
    static AabbForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        Bvh bvh;
        bvh.nodes = chunks.expectArray<Node>(kNodesType, parameters.nodeSlots);
        const uint64_t nodesOffset = chunks.payloadOffset();
        bvh.primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        judgeTree(chunks, bvh, parameters, scene, nodesOffset, sizeof(Node));
        return AabbForm(std::move(bvh));
    }
};

}  // namespace bvhio
