// The storage of the aabb form: format-spec/aabb.md, or topology.md.
#pragma once

#include "compress/aabb_form.h"
#include "file/cluster_chunk.h"
#include "file/topology.h"
#include "file/tree_chunks.h"
#include "scene/triangle_bounds.h"

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
        writeClusters(writer, form.bvh().slots);
    }
    /// Writes the tree without boxes. The reader computes them from the scene's triangles.
    static void writeTopology(ContainerWriter& writer, const AabbForm& form, const Scene& scene) {
        writeArrayChunk(writer, kPrimitivesType, form.bvh().primitives);
        writeChunk(writer, kTopologyType, topologyPayload(form.bvh(), boundsOfTriangles(scene)));
        writeClusters(writer, form.bvh().slots);
    }
    static AabbForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        Bvh bvh = chunks.nextIs(kPrimitivesType) ? readWithoutBoxes(chunks, parameters, scene)
                                                 : readWithBoxes(chunks, parameters, scene);
        if (chunks.nextIs(kClustersType)) readClusters(chunks, bvh);
        return AabbForm(std::move(bvh));
    }

  private:
    static Bvh readWithBoxes(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        Bvh bvh;
        bvh.nodes = chunks.expectArray<Node>(kNodesType, parameters.nodeSlots);
        const uint64_t nodesOffset = chunks.payloadOffset();
        bvh.primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        validateTree(chunks, bvh, parameters, scene, nodesOffset, sizeof(Node));
        return bvh;
    }
    static Bvh readWithoutBoxes(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        const auto primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        for (const uint32_t primitive : primitives)
            if (primitive >= scene.triangles.size())
                chunks.fail(FindingId::primitiveIndex,
                            "an entry refers to triangle " + std::to_string(primitive) +
                                ", but there are only " + std::to_string(scene.triangles.size()));
        Bvh bvh = readTopology(chunks, parameters, primitives, scene);
        validateTree(chunks, bvh, parameters, scene, chunks.payloadOffset(), 0, kTopologyType);
        return bvh;
    }
};

}  // namespace bvhio
