// Sources of a file's bytes: a mapped file, a pipe, or memory. Each is read once, front to back.
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
    /// Returns the next `count` bytes, or fewer if the source ends first. They are 64-byte aligned if their
    /// offset in the file is. Memory grows with the bytes that arrive, not with `count`. Throws Error{io}.
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

/// Opens a path. A regular file is mapped, and its bytes are used in place; anything else is read as a
/// stream. "-" is standard input.
std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path);
/// Opens the bytes [offset, offset + length) of a regular file as a source of their own; length 0 means up to
/// the file's end. Throws Error: io; invalid when the file ends before the range does.
std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path, uint64_t offset, uint64_t length);
/// Uses `bytes` in place. They must live as long as everything that was taken from the source. Bytes whose
/// address is not a multiple of 64 where their offset is one are copied.
std::unique_ptr<ByteSource> viewSource(std::span<const std::byte> bytes, const std::string& name);
/// Reads from `bytes`, by copying. They must live as long as the source.
std::unique_ptr<ByteSource> memorySource(std::span<const std::byte> bytes, const std::string& name);
/// Reads a file descriptor as a stream, and leaves it open.
std::unique_ptr<ByteSource> streamSource(int descriptor, const std::string& name);

}  // namespace bvhio
