// How the two-level form is stored: format-spec/two-level.md.
#pragma once

#include "compress/two_level_form.h"
#include "file/level_chunks.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<TwoLevelForm> {
    static constexpr uint32_t kCode = chunkType("two ");
    static constexpr size_t kFormSize = 64;
    static constexpr uint32_t kMaxBlasSize = kMaxLeafSize;

    static TreeParameters parameters(const TwoLevelForm& form) {
        const Bvh bvh = form.decode();
        return {kCode, bvh.nodes.size(), bvh.primitives.size(), {}, depthOf(bvh)};
    }

    static void write(ContainerWriter& writer, const TwoLevelForm& form) {
        std::visit(
            [&](const auto& tlas, const auto& blases) {
                using TlasChunks = LevelChunks<std::decay_t<decltype(tlas)>>;
                using BlasChunks = LevelChunks<std::decay_t<decltype(blases)>>;
                ByteWriter bytes;
                bytes.u32(TlasChunks::kCode);
                bytes.u32(BlasChunks::kCode);
                bytes.u32(form.options().blasSize);
                bytes.zeros(4);
                bytes.u64(TlasChunks::slots(tlas));
                bytes.u64(blases.roots().size());
                bytes.zeros(kFormSize - bytes.bytes().size());
                writeChunk(writer, kFormType, bytes.bytes());
                TlasChunks::write(writer, tlas);
                BlasChunks::write(writer, blases);
                writeArrayChunk(writer, kPrimitivesType, form.primitives());
            },
            form.tlas(), form.blases());
    }

    static TwoLevelForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        const Bytes payload = chunks.expect(kFormType, kFormSize);
        ByteReader reader(payload, "chunk FORM");
        const uint32_t tlasCode = reader.u32(), blasCode = reader.u32(), blasSize = reader.u32();
        bool zero = reader.skipZeros(4);
        LevelCounts counts;
        counts.references = parameters.references;
        counts.tlasSlots = reader.u64();
        counts.blases = reader.u64();
        counts.blasSlots = parameters.nodeSlots - counts.tlasSlots;
        zero &= reader.skipZeros(reader.remaining());
        if (!zero) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        if (counts.tlasSlots < 2 || counts.tlasSlots % 2 != 0 || counts.tlasSlots > parameters.nodeSlots ||
            counts.blases == 0 || counts.blases > parameters.references || blasSize == 0 ||
            blasSize > kMaxBlasSize)
            chunks.fail(FindingId::treeCounts, std::to_string(counts.tlasSlots) + " slots over " +
                                                   std::to_string(counts.blases) + " BLASes of at most " +
                                                   std::to_string(blasSize) +
                                                   " references are no top level of " +
                                                   std::to_string(parameters.nodeSlots) + " slots");

        auto [tlas, tlasPlace] = readLevel<TwoLevelForm::Tlas>(chunks, tlasCode, counts);
        auto [blases, blasPlace] = readLevel<TwoLevelForm::Blases>(chunks, blasCode, counts);
        TwoLevelForm form(std::move(tlas), std::move(blases),
                          chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references), blasSize);
        judgeTree(chunks, form.decode(), parameters, scene, [&](uint64_t node) {
            return node < counts.tlasSlots ? tlasPlace.of(node) : blasPlace.of(node - counts.tlasSlots);
        });
        return form;
    }

  private:
    /// Reads the level whose form has the code, and tells where its nodes are.
    template <class Variant, size_t I = 0>
    static std::pair<Variant, NodesPlace> readLevel(ChunkSequence& chunks, uint32_t code,
                                                    const LevelCounts& counts) {
        if constexpr (I == std::variant_size_v<Variant>) {
            chunks.fail(FindingId::unknownForm,
                        "unknown form '" + chunkTypeName(code) + "' of a level: use a newer bvhx");
        } else {
            using Chunks = LevelChunks<std::variant_alternative_t<I, Variant>>;
            if (Chunks::kCode == code) {
                Variant level = Chunks::read(chunks, counts);
                return {std::move(level), {Chunks::kNodesChunk, chunks.payloadOffset(), Chunks::kNodeSize}};
            }
            return readLevel<Variant, I + 1>(chunks, code, counts);
        }
    }
};

}  // namespace bvhio
