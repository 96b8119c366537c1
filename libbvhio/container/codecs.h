// The table of codecs: how a chunk's payload is squeezed (format-spec/container.md 6). A codec knows nothing
// of BVHs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/choice.h"
#include "core/shared_array.h"

namespace bvhio {

/// A payload decodes to at most this many times its stored bytes, unless it is stored as it is.
inline constexpr uint64_t kMaxExpansion = 32;

struct CodecFunctions {
    uint32_t id;  // in chunk headers
    int defaultLevel, minLevel, maxLevel;
    /// The stored form, or nothing when the payload is better stored as it is. The bytes do not depend on the
    /// number of threads.
    std::optional<AlignedVector<std::byte>> (*encode)(std::span<const std::byte> raw, int level);
    /// Fills `raw` exactly; false when `stored` is malformed.
    bool (*decode)(std::span<const std::byte> stored, std::span<std::byte> raw);
};
using Codec = Choice<CodecFunctions>;

/// All codecs to choose from; the first, none, stores payloads as they are.
std::span<const Codec> codecs();

/// What a payload is known to be: an array of 32-bit numbers, each alone or in threes.
enum class Numbers { none, single, triples };

struct EncodedPayload {
    uint32_t codec;
    AlignedVector<std::byte> bytes;
};

/// Nothing when the payload is better stored as it is. With zstd, numbers are coded by their differences
/// where that is smaller, which is a codec of its own.
std::optional<EncodedPayload> encodePayload(const Codec& codec, int level, std::span<const std::byte> raw,
                                            Numbers numbers);

/// The codec with this number in chunk headers, or nullptr.
const Codec* findCodec(uint32_t id);

}  // namespace bvhio
