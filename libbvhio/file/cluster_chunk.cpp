#include "file/cluster_chunk.h"

#include "core/bytes.h"

namespace bvhio {
namespace {

constexpr size_t kHeaderWords = 4;

}  // namespace

void writeClusters(ContainerWriter& writer, const SlotMap& slots) {
    if (slots.empty()) return;
    std::vector<uint32_t> words{slots.pointerBits, slots.lineSlots, 0, 0};
    words.insert(words.end(), slots.words.begin(), slots.words.end());
    writeArrayChunk(writer, kClustersType, SharedArray<uint32_t>(std::move(words)));
}

void readClusters(ChunkSequence& chunks, Bvh& bvh) {
    const Bytes payload = chunks.expect(kClustersType, ChunkSequence::kAnySize);
    if (payload.size() < (kHeaderWords + 1) * sizeof(uint32_t) || payload.size() % sizeof(uint32_t) != 0)
        chunks.fail(FindingId::chunkSize, "no whole header and slots");
    ByteReader reader(payload, "chunk CLUS");
    SlotMap slots;
    slots.pointerBits = reader.u32();
    slots.lineSlots = reader.u32();
    if (!reader.skipZeros(8)) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    const auto* words = reinterpret_cast<const uint32_t*>(payload.data());
    slots.words = {payload.owner(), {words + kHeaderWords, payload.size() / sizeof(uint32_t) - kHeaderWords}};
    bvh.slots = std::move(slots);
    // Of a tree that is not sound nothing can be said.
    if (!chunks.sound() || chunks.isTrusted()) return;
    if (const std::string fault = validateSlots(bvh); !fault.empty()) chunks.fail(FindingId::slots, fault);
}

}  // namespace bvhio
