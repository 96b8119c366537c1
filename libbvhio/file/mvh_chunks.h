// The storage of the mvh form: format-spec/mvh.md.
#pragma once

#include "compress/mvh_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<MvhForm> {
    static constexpr uint32_t kCode = chunkType("mvh ");
    static constexpr size_t kFormSize = 64;

    static TreeParameters parameters(const MvhForm& form) {
        return {
            kCode, size_t(form.shape().nodeCount()) + 1, form.primitives().size(), {}, form.shape().depth()};
    }
    static void write(ContainerWriter& writer, const MvhForm& form) {
        ByteWriter bytes;
        writeBox(bytes, form.bounds());
        bytes.f32(form.parameters().rule.zeta);
        bytes.f32(form.parameters().rule.zetaOfBoth);
        bytes.u32(form.parameters().rule.axes);
        bytes.u32(form.parameters().leafSize);
        bytes.zeros(kFormSize - bytes.bytes().size());
        writeChunk(writer, kFormType, bytes.bytes());
        writeArrayChunk(writer, kNodesType, form.words());
        writeArrayChunk(writer, kPrimitivesType, form.primitives());
    }
    static MvhForm read(ChunkSequence& chunks, const TreeParameters& tree, const Scene& scene) {
        if (tree.references != scene.triangles.size())
            chunks.fail(FindingId::treeCounts, std::to_string(tree.references) + " references for " +
                                                   std::to_string(scene.triangles.size()) +
                                                   " triangles, but an mvh tree has each triangle once");
        const Bytes payload = chunks.expect(kFormType, kFormSize);
        ByteReader reader(payload, "chunk FORM");
        const Aabb bounds = readBox(reader);
        MvhParameters parameters;
        MvhRule& rule = parameters.rule;
        rule.zeta = reader.f32();
        rule.zetaOfBoth = reader.f32();
        rule.axes = reader.u32();
        parameters.leafSize = reader.u32();
        if (!reader.skipZeros(reader.remaining()))
            chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        // Check what the reconstruction of boxes relies on.
        if (!isFinite(bounds.min) || !isFinite(bounds.max))
            chunks.fail(FindingId::boxNotFinite, "the root's box is not finite");
        if (!(rule.zeta > 0 && rule.zeta <= MvhRule::kMaxZeta && rule.zetaOfBoth > 0 &&
              rule.zetaOfBoth <= MvhRule::kMaxZetaOfBoth) ||
            rule.axes < 1 || rule.axes > 3 || parameters.leafSize < 1 ||
            parameters.leafSize > MvhParameters::kMaxLeafSize)
            chunks.fail(FindingId::formParameter,
                        "a zeta, the number of axes or the leaves' size is out of range");
        const MvhShape shape(uint32_t(tree.references), parameters.leafSize);
        if (tree.nodeSlots != uint64_t(shape.nodeCount()) + 1)
            chunks.fail(FindingId::treeCounts, std::to_string(tree.references) + " references in leaves of " +
                                                   std::to_string(parameters.leafSize) + " make " +
                                                   std::to_string(uint64_t(shape.nodeCount()) + 1) +
                                                   " node slots, but TREE states " +
                                                   std::to_string(tree.nodeSlots));
        SharedArray<uint32_t> words = chunks.expectArray<uint32_t>(kNodesType, MvhForm::wordCount(shape));
        if ((words[words.size() - 1] >> (shape.innerCount() % 8 * 4)) != 0)
            chunks.fail(FindingId::payloadReserved, "unused bits after the last inner node must be zero");
        const uint64_t nodesOffset = chunks.payloadOffset();
        MvhForm form(bounds, parameters, std::move(words),
                     chunks.expectArray<uint32_t>(kPrimitivesType, tree.references));
        validateForm(chunks, form, tree, scene, nodesOffset, 0);
        return form;
    }
};

}  // namespace bvhio
