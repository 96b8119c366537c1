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

/// All codecs; the first, none, stores payloads as they are.
std::span<const Codec> codecs();

/// The codec with this number in chunk headers, or nullptr.
const Codec* findCodec(uint32_t id);

}  // namespace bvhio
