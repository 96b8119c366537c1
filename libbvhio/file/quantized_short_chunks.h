// The storage of the quantized-short form: format-spec/quantized-short.md.
#pragma once

#include "compress/quantized_short_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

template <>
struct FormChunks<QuantizedShortForm> {
    static constexpr uint32_t kCode = chunkType("qush");

    static TreeParameters parameters(const QuantizedShortForm& form) {
        const Bvh bvh = form.decode();
        return {kCode, bvh.nodes.size(), form.primitives().size(), {}, depthOf(bvh)};
    }
    static void write(ContainerWriter& writer, const QuantizedShortForm& form);
    static QuantizedShortForm read(ChunkSequence& chunks, const TreeParameters& parameters,
                                   const Scene& scene);
};

}  // namespace bvhio
