// How the two-level form is stored: format-spec/two-level.md.
#pragma once

#include "compress/two_level_form.h"
#include "file/instance_tree.h"
#include "file/level_chunks.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<TwoLevelForm> {
    static constexpr uint32_t kCode = chunkType("two ");
    static constexpr size_t kFormSize = 64;
    static constexpr uint32_t kMaxBlasSize = kMaxLeafSize;

    static TreeParameters parameters(const TwoLevelForm& form) {
        if (form.isInstanced()) return parametersOfInstances(kCode, form);
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
                LevelCounts counts;
                TlasChunks::describe(tlas, counts);
                bytes.u64(TlasChunks::slots(tlas));
                bytes.u64(TlasChunks::slots(tlas) / 2);
                for (const Vec3& corner : {counts.bounds.min, counts.bounds.max})
                    for (int axis = 0; axis < 3; ++axis) bytes.f32(corner[axis]);
                bytes.u32(counts.bits);
                bytes.zeros(kFormSize - bytes.bytes().size());
                writeChunk(writer, kFormType, bytes.bytes());
                if (form.isInstanced()) writeArrayChunk(writer, kEntriesType, form.placed().instances);
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
        counts.areRuns = blasCode == LevelChunks<MvhBlases>::kCode;
        if (tlasCode == LevelChunks<QuantizedTlas>::kCode) {
            for (Vec3* corner : {&counts.bounds.min, &counts.bounds.max})
                for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.f32();
            counts.bits = reader.u32();
        }
        counts.blasSlots = parameters.nodeSlots - counts.tlasSlots;
        zero &= reader.skipZeros(reader.remaining());
        if (!zero) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        if (counts.tlasSlots < 2 || counts.tlasSlots % 2 != 0 || counts.tlasSlots > parameters.nodeSlots ||
            counts.blases != counts.tlasSlots / 2 ||
            (!scene.isInstanced() && counts.blases > parameters.references) || blasSize == 0 ||
            blasSize > kMaxBlasSize)
            chunks.fail(FindingId::treeCounts, std::to_string(counts.tlasSlots) + " slots over " +
                                                   std::to_string(counts.blases) + " BLASes of at most " +
                                                   std::to_string(blasSize) +
                                                   " references are no top level of " +
                                                   std::to_string(parameters.nodeSlots) + " slots");

        SharedArray<uint32_t> entries;
        LevelCounts bottom = counts;
        if (scene.isInstanced()) {
            if (counts.blases != scene.instances.size() || counts.areRuns)
                chunks.fail(FindingId::treeOfInstances,
                            std::to_string(counts.blases) + " leaves of the top level for " +
                                std::to_string(scene.instances.size()) + " instances, or BLASes in mvh");
            entries = readEntries(chunks, scene);
            counts.references = entries.size();
            bottom.blases = scene.meshes.size();
        }
        auto [tlas, tlasPlace] = readLevel<TwoLevelForm::Tlas>(chunks, tlasCode, counts);
        auto [blases, blasPlace] = readLevel<TwoLevelForm::Blases>(chunks, blasCode, bottom);
        if (counts.areRuns) checkRuns(chunks, tlas, std::get<MvhBlases>(blases), counts);
        // What places BLASes is made of geometry: only that which is sound.
        PlacedBlases placed;
        auto primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        if (scene.isInstanced() && chunks.sound()) placed = PlacedBlases(scene, std::move(entries));
        TwoLevelForm form(std::move(tlas), std::move(blases), std::move(primitives), blasSize,
                          std::move(placed));
        if (scene.isInstanced()) {
            if (chunks.sound()) judgeInstances(chunks, form, parameters, scene, tlasPlace, blasPlace);
            return form;
        }
        judgeTree(chunks, form.decode(), parameters, scene,
                  [&, ofTlas = tlasPlace, ofBlas = blasPlace](uint64_t node) {
                      return node < counts.tlasSlots ? ofTlas.of(node) : ofBlas.of(node - counts.tlasSlots);
                  });
        return form;
    }

  private:
    /// Whether the trees over the top level's leaves have as many slots as TREE says, and bytes that serve
    /// none are zero.
    static void checkRuns(const ChunkSequence& chunks, const TwoLevelForm::Tlas& tlas,
                          const MvhBlases& blases, const LevelCounts& counts) {
        const Bvh top = std::visit([](const auto& level) { return level.form().decode(); }, tlas);
        uint64_t slots = 0;
        for (const Node& node : top.nodes)
            if (node.isLeaf()) slots += 2 * (MvhRun{node.first, node.primitiveCount}.leafCount() - 1);
        if (slots != counts.blasSlots)
            chunks.fail(FindingId::treeCounts, "the BLASes have " + std::to_string(slots) +
                                                   " slots, TREE leaves " + std::to_string(counts.blasSlots));
        std::vector<bool> serves(blases.codes().size());
        std::vector<MvhRun> waiting;
        for (const Node& node : top.nodes)
            if (node.isLeaf()) waiting.push_back({node.first, node.primitiveCount});
        while (!waiting.empty()) {
            const MvhRun run = waiting.back();
            waiting.pop_back();
            if (run.isLeaf()) continue;
            serves[run.codes()] = true;
            waiting.push_back(run.left());
            waiting.push_back(run.right());
        }
        for (size_t i = 0; i < serves.size(); ++i)
            if (!serves[i] && blases.codes()[i] != 0)
                chunks.fail(FindingId::payloadReserved,
                            "byte " + std::to_string(i) + " serves no node and is not zero");
    }

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
                uint64_t offset = chunks.payloadOffset();
                if constexpr (requires { Chunks::nodesOffset(offset); }) offset = Chunks::nodesOffset(offset);
                return {std::move(level), {Chunks::kNodesChunk, offset, Chunks::kNodeSize}};
            }
            return readLevel<Variant, I + 1>(chunks, code, counts);
        }
    }
};

}  // namespace bvhio
