// The digest of large byte strings (format-spec/container.md 4), which several threads can compute.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bvhio {

/// Payloads are hashed, and compressed, in blocks of this many bytes.
inline constexpr size_t kBlockSize = size_t(1) << 20;

/// Returns XXH3-64 of the hashes of all blocks. Uses all threads.
uint64_t digest(std::span<const std::byte> bytes);

}  // namespace bvhio
