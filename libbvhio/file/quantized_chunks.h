// The storage of the quantized form: format-spec/quantized.md.
#pragma once

#include "compress/quantized_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<QuantizedForm> {
    static constexpr uint32_t kCode = chunkType("quan");
    static constexpr size_t kFormSize = 64;

    static TreeParameters parameters(const QuantizedForm& form) {
        return {kCode, 2 * form.records().size() + 2, form.primitives().size(), {}, depthOf(form.decode())};
    }
    static void write(ContainerWriter& writer, const QuantizedForm& form) {
        ByteWriter bytes;
        writeBox(bytes, form.bounds());
        bytes.u32(form.bits());
        bytes.zeros(kFormSize - bytes.bytes().size());
        writeChunk(writer, kFormType, bytes.bytes());
        writeArrayChunk(writer, kNodesType, form.records());
        writeArrayChunk(writer, kPrimitivesType, form.primitives());
    }
    static QuantizedForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        if (parameters.references > QuantizedRecord::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "a quantized tree has at most 2^29 references");
        if (parameters.nodeSlots == 2 && parameters.references > QuantizedRecord::kMaxLeafSize)
            chunks.fail(FindingId::treeCounts, "a leaf of a quantized tree has at most 128 references");
        const Bytes payload = chunks.expect(kFormType, kFormSize);
        ByteReader reader(payload, "chunk FORM");
        const Aabb bounds = readBox(reader);
        const uint32_t bits = reader.u32();
        if (!reader.skipZeros(reader.remaining()))
            chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        checkBounds(chunks, bounds);
        checkBits(chunks, bits);
        const size_t count = parameters.nodeSlots / 2 - 1;
        SharedArray<QuantizedRecord> records = chunks.expectArray<QuantizedRecord>(kNodesType, count);
        for (size_t i = 0; i < count; ++i) checkRecord(chunks, records[i], i, count, bits);
        // Node 2 r + 2 is the first half of record r. The root and its unused neighbor, which come before,
        // are not stored.
        constexpr size_t nodeSize = sizeof(QuantizedRecord) / 2;
        const uint64_t nodesOffset = chunks.payloadOffset() - 2 * nodeSize;
        QuantizedForm form(bounds, bits, std::move(records),
                           chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references));
        validateForm(chunks, form, parameters, scene, nodesOffset, nodeSize);
        return form;
    }

    static void checkBounds(const ChunkSequence& chunks, const Aabb& bounds) {
        if (bounds.isEmpty() || !isFinite(bounds.min) || !isFinite(bounds.max))
            chunks.fail(FindingId::boxNotFinite, "the root's box is not finite or has min > max");
    }
    static void checkBits(const ChunkSequence& chunks, uint32_t bits) {
        if (bits < QuantizedRecord::kMinBits || bits > QuantizedRecord::kMaxBits)
            chunks.fail(FindingId::formParameter,
                        "planes have " + std::to_string(bits) + " bits, but only 5 to 8 are possible");
    }
    /// Checks what decoding relies on. The decoded tree may still be invalid.
    static void checkRecord(const ChunkSequence& chunks, const QuantizedRecord& record, size_t index,
                            size_t count, uint32_t bits) {
        for (uint32_t side = 0; side < 6; ++side)
            if (record.inset(side) >> bits != 0)
                chunks.fail(FindingId::nodeField, "record " + std::to_string(index) + " moves a plane by " +
                                                      std::to_string(record.inset(side)) + " steps of 2^-" +
                                                      std::to_string(bits));
        for (uint32_t child = 0; child < 2; ++child) {
            const uint32_t word = record.children[child];
            if (QuantizedRecord::isLeaf(word)) continue;
            if (record.highBits(child) >> 3 != 0)
                chunks.fail(FindingId::nodeField, "record " + std::to_string(index) +
                                                      " gives a size to a child that is not a leaf");
            if (QuantizedRecord::record(word) <= index || QuantizedRecord::record(word) >= count)
                chunks.fail(FindingId::childIndex,
                            "record " + std::to_string(index) + " has a child with record " +
                                std::to_string(QuantizedRecord::record(word)) +
                                ", which is not after it and below " + std::to_string(count));
        }
    }
};

}  // namespace bvhio
