// The table of codecs, which compress the payloads of chunks (format-spec/container.md 6). A codec knows
// nothing of BVHs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/choice.h"
#include "core/shared_array.h"

namespace bvhio {

/// A compressed payload decodes to at most this many times its stored bytes.
inline constexpr uint64_t kMaxExpansion = 32;

struct CodecFunctions {
    uint32_t id;  // in chunk headers
    int defaultLevel, minLevel, maxLevel;
    /// Returns the compressed bytes, or nothing if the payload is better stored as it is. The bytes do not
    /// depend on the number of threads.
    std::optional<AlignedVector<std::byte>> (*encode)(std::span<const std::byte> raw, int level);
    /// Fills `raw` exactly. Returns false if `stored` is malformed.
    bool (*decode)(std::span<const std::byte> stored, std::span<std::byte> raw);
};
using Codec = Choice<CodecFunctions>;

/// Returns the codecs to choose from. The first, `none`, stores payloads as they are.
std::span<const Codec> codecs();

/// Whether a payload is an array of 32-bit numbers, and whether these come one by one or in threes.
enum class Numbers { none, single, triples };

struct EncodedPayload {
    uint32_t codec;
    AlignedVector<std::byte> bytes;
};

/// Encodes a payload; returns nothing if it is better stored as it is. With zstd, `numbers` may also be coded
/// by their differences, by a codec of its own, and are if that is smaller.
std::optional<EncodedPayload> encodePayload(const Codec& codec, int level, std::span<const std::byte> raw,
                                            Numbers numbers);

/// Returns the codec with this number in chunk headers, or nullptr.
const Codec* findCodec(uint32_t id);

}  // namespace bvhio
