// Bounded little-endian reading and writing of bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bvhio {

// Files store arrays of nodes, vertices and indices with the same bytes as in memory.
static_assert(std::endian::native == std::endian::little,
              "bvhio stores arrays as they are in memory: little-endian");

/// Reads numbers from the front of a byte string. Reading more than is left throws Error{invalid}.
class ByteReader {
  public:
    /// Keeps a view: the bytes must outlive the reader. `what` names the bytes in messages ("chunk PROV").
    ByteReader(std::span<const std::byte> bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

    size_t position() const { return position_; }
    size_t remaining() const { return bytes_.size() - position_; }
    uint16_t u16() { return number<uint16_t>(); }
    uint32_t u32() { return number<uint32_t>(); }
    uint64_t u64() { return number<uint64_t>(); }
    float f32() { return number<float>(); }
    std::span<const std::byte> bytes(uint64_t count) {
        if (count > remaining())
            throw Error(ErrorKind::invalid, what_ + " at byte " + std::to_string(position_) + ": " +
                                                std::to_string(count) + " bytes needed, " +
                                                std::to_string(remaining()) + " left");
        const auto result = bytes_.subspan(position_, size_t(count));
        position_ += size_t(count);
        return result;
    }
    std::string string(uint64_t count) {
        const auto view = bytes(count);
        return {reinterpret_cast<const char*>(view.data()), view.size()};
    }
    /// Skips `count` bytes and returns whether all of them are zero.
    bool skipZeros(uint64_t count) {
        bool zero = true;
        for (const std::byte b : bytes(count)) zero &= b == std::byte{0};
        return zero;
    }

  private:
    template <class T>
    T number() {
        T value;
        std::memcpy(&value, bytes(sizeof(T)).data(), sizeof(T));
        return value;
    }

    std::span<const std::byte> bytes_;
    std::string what_;
    size_t position_ = 0;
};

/// Appends little-endian numbers to a byte string.
class ByteWriter {
  public:
    void u16(uint16_t v) { append(&v, sizeof v); }
    void u32(uint32_t v) { append(&v, sizeof v); }
    void u64(uint64_t v) { append(&v, sizeof v); }
    void f32(float v) { append(&v, sizeof v); }
    void string(std::string_view s) { append(s.data(), s.size()); }
    void zeros(size_t count) { bytes_.resize(bytes_.size() + count); }
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    void append(const void* data, size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::byte> bytes_;
};

}  // namespace bvhio
