#include "file/bvhx_file.h"

#include <algorithm>
#include <ostream>

#include "core/bytes.h"
#include "file/chunks.h"
#include "file/content.h"
#include "file/form_chunks.h"
#include "file/scene_chunks.h"
#include "file/utf8.h"
#include "file/visit_chunk.h"
#include "scene/check_scene.h"

namespace bvhio {
namespace {

void writeProvenance(ContainerWriter& writer, const std::vector<ProvenanceEntry>& entries) {
    ByteWriter bytes;
    bytes.u32(uint32_t(entries.size()));
    bytes.u32(0);
    for (const ProvenanceEntry& entry : entries)
        for (const std::string& text : {toUtf8(entry.tool), toUtf8(entry.version), toUtf8(entry.options)}) {
            bytes.u32(uint32_t(text.size()));
            bytes.string(text);
        }
    writeChunk(writer, kProvenanceType, bytes.bytes());
}

std::vector<ProvenanceEntry> readProvenance(ChunkSequence& chunks) {
    const Bytes payload = chunks.expect(kProvenanceType, ChunkSequence::kAnySize);
    ByteReader reader(payload, "chunk PROV");
    const auto need = [&](uint64_t count) {
        if (reader.remaining() < count)
            chunks.fail(FindingId::provenance, "an entry reaches beyond the payload");
    };
    need(8);
    const uint32_t count = reader.u32();
    if (reader.u32() != 0) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    need(uint64_t(count) * 12);
    std::vector<ProvenanceEntry> entries(count);
    for (ProvenanceEntry& entry : entries)
        for (std::string* text : {&entry.tool, &entry.version, &entry.options}) {
            need(4);
            const uint32_t length = reader.u32();
            need(length);
            *text = reader.string(length);
            if (!isUtf8(*text)) chunks.fail(FindingId::text, "a text is not UTF-8");
        }
    if (reader.remaining() != 0) chunks.fail(FindingId::provenance, "bytes follow the last entry");
    return entries;
}

}  // namespace

BvhxFile readContent(ContainerReader& container, std::vector<Finding>* collected) {
    ChunkSequence chunks(container, collected);
    Scene scene = readScene(chunks);
    StoredTree tree = readTree(chunks, scene);
    SharedArray<uint32_t> visits;
    if (const Bvh* bvh = canonicalTree(tree.bvh)) visits = readVisits(chunks, *bvh);
    std::vector<ProvenanceEntry> provenance;
    if (chunks.nextIs(kProvenanceType)) provenance = readProvenance(chunks);
    chunks.expect(kEndType, ChunkSequence::kAnySize);
    return {std::move(scene),      std::move(tree.bvh),  tree.costs,
            std::move(provenance), chunks.takeUnknown(), std::move(visits)};
}

BvhxFile readBvhx(const std::filesystem::path& path) {
    const auto source = openSource(path);
    ContainerReader container(*source);
    return readContent(container);
}

BvhxFile readBvhx(std::span<const std::byte> bytes, const std::string& name) {
    const auto source = memorySource(bytes, name);
    ContainerReader container(*source);
    return readContent(container);
}

std::optional<EncodedBvh> writeBvhx(std::ostream& out, const BvhxFile& file, const WriteOptions& options) {
    checkScene(file.scene);
    ContainerWriter writer(out, choose(codecs(), "codec", options.codec), options.codecLevel);
    const StoredScene stored = storeScene(file.scene, options);
    writeScene(writer, stored);
    std::optional<EncodedBvh> refitted;
    if (!stored.draco.empty()) refitted = refitTo(file.bvh, stored.scene);
    writeTree(writer, refitted ? *refitted : file.bvh, file.costs, stored.scene, options.nodes);
    if (!file.visits.empty()) writeArrayChunk(writer, kVisitsType, file.visits);
    for (const UnknownChunk& chunk : file.unknownChunks) writer.write(chunk.type, chunk.flags, chunk.payload);
    if (!file.provenance.empty()) writeProvenance(writer, file.provenance);
    writer.finish();
    return refitted;
}

void dropChunksThatDoNotSurvive(BvhxFile& file, Change change) {
    file.visits = {};
    const uint32_t needed = change == Change::reordered ? kSurvivesReorder : kSurvivesTopologyChange;
    std::erase_if(file.unknownChunks, [&](const UnknownChunk& chunk) { return (chunk.flags & needed) == 0; });
}

}  // namespace bvhio
