#include "file/quantized_short_chunks.h"

#include "core/bytes.h"

namespace bvhio {
namespace {

constexpr size_t kFormSize = 64;

std::string named(const char* what, uint64_t index) {
    return std::string(what).append(" ").append(std::to_string(index));
}

/// The fields of FORM.
struct Parameters {
    Aabb bounds;
    uint32_t pointerBits, lineSlots;
    uint64_t slots;
};

Parameters readForm(ChunkSequence& chunks) {
    const Bytes payload = chunks.expect(kFormType, kFormSize);
    ByteReader reader(payload, "chunk FORM");
    Parameters p;
    p.bounds = readBox(reader);
    p.pointerBits = reader.u32();
    p.lineSlots = reader.u32();
    p.slots = reader.u64();
    if (!reader.skipZeros(reader.remaining()))
        chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    if (p.bounds.isEmpty() || !isFinite(p.bounds.min) || !isFinite(p.bounds.max))
        chunks.fail(FindingId::boxNotFinite, "the root's box is not finite or has min > max");
    if (p.pointerBits < SlotMap::kMinPointerBits || p.pointerBits > SlotMap::kMaxPointerBits)
        chunks.fail(FindingId::formParameter, "pointers have " + std::to_string(p.pointerBits) +
                                                  " bits, but only 2 to 10 are possible");
    if (!std::has_single_bit(p.lineSlots) || p.lineSlots > SlotMap::kMaxLineSlots)
        chunks.fail(FindingId::formParameter,
                    "lines have " + std::to_string(p.lineSlots) + " slots, not a power of two up to 64");
    if (p.slots > 0xFFFFFFFF) chunks.fail(FindingId::formParameter, "more than 2^32 - 1 slots");
    return p;
}

/// Checks what decoding relies on, and finds each record's slot. The decoded tree may still be invalid.
class SlotCheck {
  public:
    SlotCheck(ChunkSequence& chunks, const QuantizedShortForm& form)
        : chunks_(chunks), form_(form), clusters_(form.slots().size()) {
        const SharedArray<ShortRecord>& slots = form.slots();
        if (!slots.empty()) {
            if (slots[0].isGlue()) fail(FindingId::childIndex, 0, "does not hold the root's children");
            reach(0, {0, 0});
        }
        uint32_t started = 0;  // the cluster's first slot
        for (uint32_t slot = 0; slot < slots.size(); ++slot) {
            const ShortRecord& record = slots[slot];
            if (!clusters_[slot].isReached) {
                if (!record.isEmpty()) fail(FindingId::sharedChildren, slot, "does not belong to a parent");
                continue;
            }
            if (clusters_[slot].firstSlot == slot) started = slot;
            if (clusters_[slot].firstSlot != started)
                fail(FindingId::slots, slot, "belongs to another cluster than the slots around it");
            if (record.isGlue()) {
                followGlue(slot, record);
            } else {
                recordSlots_.push_back(slot);
                for (uint32_t child = 0; child < 2; ++child) followReference(slot, record.reference(child));
            }
        }
    }

    const std::vector<uint32_t>& recordSlots() const { return recordSlots_; }

  private:
    struct Cluster {
        uint32_t firstSlot = 0, firstEntry = 0;
        bool isReached = false;
    };

    [[noreturn]] void fail(FindingId id, uint64_t slot, const std::string& what) const {
        chunks_.fail(id, named("slot", slot).append(" ").append(what));
    }
    void reach(uint32_t slot, Cluster cluster) {
        if (clusters_[slot].isReached) fail(FindingId::sharedChildren, slot, "belongs to several parents");
        cluster.isReached = true;
        clusters_[slot] = cluster;
    }
    void followGlue(uint32_t slot, const ShortRecord& glue) {
        const uint64_t target = uint64_t(glue.line()) * form_.lineSlots();
        if (target <= slot || target >= form_.slots().size() || form_.slots()[target].isGlue())
            fail(FindingId::childIndex, slot,
                 named("leads to slot", target) + ", which is not after it or does not hold a record");
        reach(uint32_t(target), {uint32_t(target), glue.firstEntry()});
    }
    void followReference(uint32_t slot, uint32_t reference) {
        const Cluster& cluster = clusters_[slot];
        if (reference >> form_.pointerBits() == 0) {
            const uint64_t target = uint64_t(cluster.firstSlot) + reference;
            if (target <= slot || target >= form_.slots().size() || form_.slots()[target].isEmpty())
                fail(FindingId::childIndex, slot,
                     named("has a child in slot", target) + ", which is not after it or is empty");
            reach(uint32_t(target), cluster);
            return;
        }
        const uint32_t first = form_.firstEntryOf(cluster.firstEntry, reference);
        if (first >= form_.primitives().size() || form_.countFrom(first) > ShortRecord::kMaxLeafSize)
            fail(FindingId::leafRange, slot,
                 named("has a leaf of entries from", first) + " on, which is empty or too large");
    }

    ChunkSequence& chunks_;
    const QuantizedShortForm& form_;
    std::vector<Cluster> clusters_;  // of each slot
    std::vector<uint32_t> recordSlots_;
};

SharedArray<uint32_t> readLastEntries(ChunkSequence& chunks, uint64_t references) {
    SharedArray<uint32_t> words =
        chunks.expectArray<uint32_t>(kLastEntriesType, QuantizedShortForm::lastEntryWords(references));
    if (words[words.size() - 1] != 0 ||
        (references % 32 != 0 && words[references / 32] >> references % 32 != 0))
        chunks.fail(FindingId::payloadReserved, "unused bits of LAST must be zero");
    return words;
}

}  // namespace

void FormChunks<QuantizedShortForm>::write(ContainerWriter& writer, const QuantizedShortForm& form) {
    ByteWriter bytes;
    writeBox(bytes, form.bounds());
    bytes.u32(form.pointerBits());
    bytes.u32(form.lineSlots());
    bytes.u64(form.slots().size());
    bytes.zeros(kFormSize - bytes.bytes().size());
    writeChunk(writer, kFormType, bytes.bytes());
    writeArrayChunk(writer, kNodesType, form.slots());
    if (!form.lastEntries().empty()) writeArrayChunk(writer, kLastEntriesType, form.lastEntries());
    writeArrayChunk(writer, kPrimitivesType, form.primitives());
}

QuantizedShortForm FormChunks<QuantizedShortForm>::read(ChunkSequence& chunks,
                                                        const TreeParameters& parameters,
                                                        const Scene& scene) {
    if (parameters.references > ShortRecord::kMaxReferences)
        chunks.fail(FindingId::treeCounts, "a quantized-short tree has at most 2^27 references");
    if (parameters.nodeSlots == 2 && parameters.references > ShortRecord::kMaxLeafSize)
        chunks.fail(FindingId::treeCounts, "a leaf of a quantized-short tree has at most 32 references");
    const Parameters p = readForm(chunks);
    SharedArray<ShortRecord> slots = chunks.expectArray<ShortRecord>(kNodesType, p.slots);
    const uint64_t nodesOffset = chunks.payloadOffset();
    SharedArray<uint32_t> lastEntries;
    if (parameters.references != parameters.nodeSlots / 2)
        lastEntries = readLastEntries(chunks, parameters.references);
    const QuantizedShortForm form(p.bounds, p.pointerBits, p.lineSlots, std::move(slots),
                                  std::move(lastEntries),
                                  chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references));
    const SlotCheck check(chunks, form);
    const size_t records = check.recordSlots().size();
    if (2 * records + 2 != parameters.nodeSlots)
        chunks.fail(FindingId::treeCounts, std::to_string(records) + " records do not make the " +
                                               std::to_string(parameters.nodeSlots) +
                                               " node slots that TREE states");
    if (records == 0 && form.countFrom(0) != parameters.references)
        chunks.fail(FindingId::leafRange, "the root does not own all entries");
    constexpr size_t nodeSize = sizeof(ShortRecord) / 2;
    validateForm(chunks, form, parameters, scene, [&](uint64_t node) {
        if (node < 2) return NodesPlace{kNodesType, nodesOffset, nodeSize};
        const uint32_t slot = check.recordSlots()[node / 2 - 1];
        return NodesPlace{kNodesType, nodesOffset + slot * sizeof(ShortRecord) + node % 2 * nodeSize,
                          nodeSize};
    });
    return form;
}

}  // namespace bvhio
