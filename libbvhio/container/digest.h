// The digest of large byte strings (format-spec/container.md 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bvhio {

/// Payloads are hashed, and compressed, in blocks of this many bytes.
inline constexpr size_t kBlockSize = size_t(1) << 20;

/// XXH3-64 of the block hashes; uses all threads.
uint64_t digest(std::span<const std::byte> bytes);

}  // namespace bvhio
