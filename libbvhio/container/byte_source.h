// Where the bytes of a file come from: a mapped file, a pipe, or memory. All are read once, front to back.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "core/shared_array.h"

namespace bvhio {

using Bytes = SharedArray<std::byte>;

class ByteSource {
  public:
    virtual ~ByteSource() = default;
    /// The next `count` bytes, 64-byte aligned where the file offset is; fewer only when the source ends
    /// first. Memory grows with the bytes that arrive, not with `count`. Throws Error{io}.
    Bytes take(uint64_t count) {
        Bytes bytes = takeNext(count);
        position_ += bytes.size();
        return bytes;
    }
    uint64_t position() const { return position_; }
    const std::string& name() const { return name_; }

  protected:
    explicit ByteSource(std::string name) : name_(std::move(name)) {}

  private:
    virtual Bytes takeNext(uint64_t count) = 0;

    std::string name_;
    uint64_t position_ = 0;
};

/// Opens a path: a regular file is mapped and its bytes are used in place; anything else is read as a stream.
/// "-" is standard input.
std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path);
/// Copies what is taken from `bytes`, which must live as long as the source.
std::unique_ptr<ByteSource> memorySource(std::span<const std::byte> bytes, const std::string& name);
/// Reads a file descriptor, which stays open, as a stream.
std::unique_ptr<ByteSource> streamSource(int descriptor, const std::string& name);

}  // namespace bvhio
