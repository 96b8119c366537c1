// The fixed bytes and sizes of format-spec/container.md, for the reader and the writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bvhio {

inline constexpr std::array<unsigned char, 12> kSignature = {0x9C, 'B',  'V',  'H',  'X',  ' ',
                                                             '\r', '\n', 0x1A, '\n', 0x00, 0xFE};
inline constexpr size_t kHeaderSize = 64;   // of the file's header and of every chunk's
inline constexpr size_t kCheckedSize = 56;  // the bytes of a header before its checksum
inline constexpr size_t kEndSize = 32;      // END's payload
inline constexpr uint64_t kMaxPayload = uint64_t(1) << 48;

/// Returns the bytes of padding after `size` bytes that start at a multiple of 64.
constexpr size_t paddingAfter(uint64_t size) {
    return size_t((64 - size % 64) % 64);
}

}  // namespace bvhio
