#include "file/chunks.h"

#include <algorithm>

namespace bvhio {

std::span<const ChunkKind> chunkKinds() {
    constexpr uint32_t all = kCritical | kSurvivesReorder | kSurvivesTopologyChange;
    static constexpr ChunkKind kTable[] = {
        {kSceneType, all, "scene parameters"},
        {kVerticesType, all, "vertices"},
        {kTrianglesType, all, "triangles"},
        {kDracoType, all, "Draco geometry"},
        {kGeometriesType, all, "geometries"},
        {kSourcePrimitivesType, all, "source primitives"},
        {kMeshesType, all, "meshes"},
        {kInstancesType, all, "instances"},
        {kTreeType, kCritical, "tree parameters"},
        {kFormType, kCritical, "form parameters"},
        {kNodesType, kCritical, "nodes"},
        {kEntriesType, kCritical, "instances in the order of the top level"},
        {kTlasType, kCritical, "nodes of the top level"},
        {kRootsType, kCritical, "roots of the bottom level"},
        {kBlasType, kCritical, "nodes of the bottom level"},
        {kLastEntriesType, kCritical, "last entries of leaves"},
        {kPrimitivesType, kCritical, "primitives"},
        {kTopologyType, kCritical, "topology"},
        {kClustersType, 0, "clusters"},
        {kVisitsType, 0, "visits"},
        {kProvenanceType, kSurvivesReorder | kSurvivesTopologyChange, "provenance"},
        {kEndType, kCritical, "end"},
    };
    return kTable;
}

const ChunkKind* findChunkKind(uint32_t type) {
    for (const ChunkKind& kind : chunkKinds())
        if (kind.type == type) return &kind;
    return nullptr;
}

void writeChunk(ContainerWriter& writer, uint32_t type, std::span<const std::byte> payload, Numbers numbers) {
    writer.write(type, findChunkKind(type)->flags, payload, numbers);
}

const ChunkHeader& ChunkSequence::peek() {
    while (!next_) {
        const ChunkHeader header = *reader_.nextHeader();
        if (const ChunkKind* kind = findChunkKind(header.type)) {
            if (header.type != kEndType && header.flags != kind->flags)
                fail(FindingId::chunkFlags, "the flags are " + std::to_string(header.flags) +
                                                ", but must be " + std::to_string(kind->flags));
            if (std::find(seen_.begin(), seen_.end(), header.type) != seen_.end())
                fail(FindingId::chunkRepeated, "the chunk appears twice");
            seen_.push_back(header.type);
            next_ = header;
        } else if ((header.flags & kCritical) != 0) {
            fail(FindingId::unknownCriticalChunk, "unknown and critical: use a newer bvhx");
        } else {
            const Bytes payload = reader_.payload();
            unknown_.push_back({header.type, header.flags, {payload.begin(), payload.end()}});
        }
    }
    return *next_;
}

void ChunkSequence::addFindings(std::vector<Finding> findings, uint64_t payload) {
    for (Finding& finding : findings) {
        if (finding.offset != kNowhere) finding.offset += payload;
        if (!collected_) throw FindingError(reader_.name(), finding);
        collected_->push_back(std::move(finding));
    }
}

bool ChunkSequence::nextIs(uint32_t type) {
    return peek().type == type;
}

Bytes ChunkSequence::expect(uint32_t type, uint64_t size) {
    if (peek().type != type)
        fail(FindingId::chunkExpected, "chunk " + chunkTypeName(type) + " is expected here");
    if (size != kAnySize && next_->rawSize != size)
        fail(FindingId::chunkSize, "the payload has " + std::to_string(next_->rawSize) +
                                       " bytes, but the counts require " + std::to_string(size));
    next_.reset();
    return reader_.payload();
}

}  // namespace bvhio
