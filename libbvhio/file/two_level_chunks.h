// The storage of the two-level form: format-spec/two-level.md.
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
    // The value of the field in an instanced scene, where it has no meaning: each mesh is one BLAS.
    static constexpr uint32_t kBlasSizeOfMeshes = 16;

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
                bytes.u32(form.isInstanced() ? kBlasSizeOfMeshes : form.options().blasSize);
                bytes.u32(isMvh(BlasChunks::kCode) ? form.options().blasLeafSize : 0);
                LevelCounts counts;
                TlasChunks::describe(tlas, counts);
                bytes.u64(TlasChunks::slots(tlas));
                bytes.u64(TlasChunks::slots(tlas) / 2);
                writeBox(bytes, counts.bounds);
                const bool hasBits = isQuantized(TlasChunks::kCode) || isQuantized(BlasChunks::kCode);
                bytes.u32(hasBits ? form.options().bits : 0);
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
        const bool isOverMvh = isMvh(blasCode);
        LevelCounts counts;
        counts.leafSize = reader.u32();
        bool zero = isOverMvh || counts.leafSize == 0;
        counts.references = parameters.references;
        counts.tlasSlots = reader.u64();
        counts.blases = reader.u64();
        counts.areRuns = isOverMvh && !scene.isInstanced();
        if (isQuantized(tlasCode)) {
            counts.bounds = readBox(reader);
        } else {
            zero &= reader.skipZeros(sizeof(Aabb));
        }
        const bool hasBits = isQuantized(tlasCode) || isQuantized(blasCode);
        if (hasBits) counts.bits = reader.u32();
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
                                                   " references cannot form a top level of a tree of " +
                                                   std::to_string(parameters.nodeSlots) + " slots");

        if (hasBits) FormChunks<QuantizedForm>::checkBits(chunks, counts.bits);
        if (isOverMvh && (counts.leafSize < 1 || counts.leafSize > NibbleRuns::kMaxLeafSize))
            chunks.fail(FindingId::formParameter, "leaves of mvh BLASes have " +
                                                      std::to_string(counts.leafSize) +
                                                      " triangles, but only 1 to 16 are possible");

        SharedArray<uint32_t> entries;
        LevelCounts bottom = counts;
        if (scene.isInstanced()) {
            if (counts.blases != scene.instances.size())
                chunks.fail(FindingId::treeOfInstances,
                            "the top level has " + std::to_string(counts.blases) + " leaves for " +
                                std::to_string(scene.instances.size()) + " instances");
            if (isOverMvh && parameters.references != scene.triangles.size())
                chunks.fail(FindingId::treeCounts, std::to_string(parameters.references) +
                                                       " references for " +
                                                       std::to_string(scene.triangles.size()) +
                                                       " triangles, but mvh BLASes have each triangle once");
            entries = readEntries(chunks, scene);
            counts.references = entries.size();
            bottom.blases = scene.meshes.size();
        }
        auto [tlas, tlasPlace] = readLevel<TwoLevelForm::Tlas>(chunks, tlasCode, counts);
        auto [blases, blasPlace] = readLevel<TwoLevelForm::Blases>(chunks, blasCode, bottom);
        if (isOverMvh && (chunks.sound() || !scene.isInstanced())) {
            std::vector<PrimitiveRange> runs;
            if (scene.isInstanced())
                for (const SceneMesh& mesh : scene.meshes)
                    runs.push_back({mesh.firstTriangle, mesh.triangleCount});
            else
                runs = runsOf(tlas);
            checkRuns(chunks, runs, std::get<NibbleBlases>(blases), counts.blasSlots);
        }
        // Instances are placed by the boxes of meshes, which only valid geometry has.
        PlacedBlases placed;
        auto primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        if (scene.isInstanced() && chunks.sound())
            placed = PlacedBlases(scene, std::move(entries), isOverMvh);
        TwoLevelForm form(std::move(tlas), std::move(blases), std::move(primitives), blasSize,
                          std::move(placed));
        if (scene.isInstanced()) {
            if (chunks.sound()) validateInstances(chunks, form, parameters, scene, tlasPlace, blasPlace);
            return form;
        }
        validateForm(
            chunks, form, parameters, scene, [&, ofTlas = tlasPlace, ofBlas = blasPlace](uint64_t node) {
                return node < counts.tlasSlots ? ofTlas.of(node) : ofBlas.of(node - counts.tlasSlots);
            });
        return form;
    }

  private:
    static constexpr bool isMvh(uint32_t code) { return code == LevelChunks<NibbleBlases>::kCode; }
    static constexpr bool isQuantized(uint32_t code) { return code == FormChunks<QuantizedForm>::kCode; }

    /// Returns the entries that each leaf of a top level owns.
    static std::vector<PrimitiveRange> runsOf(const TwoLevelForm::Tlas& tlas) {
        const Bvh top = std::visit([](const auto& level) { return level.form().decode(); }, tlas);
        std::vector<PrimitiveRange> runs;
        for (const Node& node : top.nodes)
            if (node.isLeaf()) runs.push_back({node.first, node.primitiveCount});
        return runs;
    }

    /// Checks that the trees over the runs have as many slots as TREE states, and that unused bytes are zero.
    static void checkRuns(const ChunkSequence& chunks, std::span<const PrimitiveRange> runs,
                          const NibbleBlases& blases, uint64_t blasSlots) {
        const NibbleRuns& shape = blases.shape();
        uint64_t slots = 0;
        std::vector<NibbleRun> waiting;
        for (const PrimitiveRange& run : runs) {
            waiting.push_back(shape.root(run));
            slots += waiting.back().slotsBelow();
        }
        if (slots != blasSlots)
            chunks.fail(FindingId::treeCounts, "the BLASes have " + std::to_string(slots) +
                                                   " slots, but TREE leaves them " +
                                                   std::to_string(blasSlots));
        std::vector<bool> serves(blases.codes().size());
        while (!waiting.empty()) {
            const NibbleRun run = waiting.back();
            waiting.pop_back();
            if (run.isLeaf()) continue;
            serves[run.codes()] = true;
            waiting.push_back(shape.left(run));
            waiting.push_back(shape.right(run));
        }
        for (size_t i = 0; i < serves.size(); ++i)
            if (!serves[i] && blases.codes()[i] != 0)
                chunks.fail(FindingId::payloadReserved,
                            "byte " + std::to_string(i) + " belongs to no node, so it must be zero");
    }

    /// Reads a level of the form with this code, and returns it and the place of its nodes.
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
