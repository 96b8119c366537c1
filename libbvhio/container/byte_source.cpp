#include "container/byte_source.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace bvhio {
namespace {

[[noreturn]] void failIo(const std::string& name, const char* what) {
    throw Error(ErrorKind::io, name + ": cannot be " + what + ": " + std::strerror(errno));
}

/// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    int get() const { return value_; }

  private:
    int value_;
};

class MemorySource : public ByteSource {
  public:
    MemorySource(std::span<const std::byte> bytes, const std::string& name)
        : ByteSource(name), bytes_(bytes) {}

  private:
    Bytes takeNext(uint64_t count) override {
        const auto part = bytes_.first(size_t(std::min<uint64_t>(count, bytes_.size())));
        bytes_ = bytes_.subspan(part.size());
        return AlignedVector<std::byte>(part.begin(), part.end());
    }

    std::span<const std::byte> bytes_;
};

/// Memory that is used in place. The owner, a mapping for instance, lives as long as any array that views the
/// memory. Without an owner, the caller keeps the memory alive.
class ViewedSource : public ByteSource {
  public:
    ViewedSource(std::shared_ptr<const void> owner, std::span<const std::byte> bytes, const std::string& name)
        : ByteSource(name), owner_(std::move(owner)), bytes_(bytes) {}

  private:
    Bytes takeNext(uint64_t count) override {
        const auto part = bytes_.first(size_t(std::min<uint64_t>(count, bytes_.size())));
        bytes_ = bytes_.subspan(part.size());
        // Arrays are used where they lie, and nodes must be aligned to cache lines: copy if they are not.
        if (reinterpret_cast<uintptr_t>(part.data()) % kAlignment != position() % kAlignment)
            return AlignedVector<std::byte>(part.begin(), part.end());
        return {owner_, part};
    }

    static constexpr size_t kAlignment = 64;
    std::shared_ptr<const void> owner_;
    std::span<const std::byte> bytes_;
};

class StreamSource : public ByteSource {
  public:
    StreamSource(int descriptor, const std::string& name) : ByteSource(name), descriptor_(descriptor) {}
    StreamSource(Descriptor owned, const std::string& name)
        : ByteSource(name), owned_(std::move(owned)), descriptor_(owned_.get()) {}

  private:
    Bytes takeNext(uint64_t count) override {
        AlignedVector<std::byte> bytes;
        size_t filled = 0;
        while (filled < count) {
            // Memory doubles as bytes arrive, so a false claim of a large size costs nothing.
            if (filled == bytes.size())
                bytes.resize(
                    size_t(std::min<uint64_t>(count, std::max<size_t>(size_t(1) << 20, 2 * filled))));
            const ssize_t got = ::read(descriptor_, bytes.data() + filled, bytes.size() - filled);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) failIo(name(), "read");
            if (got == 0) break;
            filled += size_t(got);
        }
        bytes.resize(filled);
        return bytes;
    }

    Descriptor owned_{-1};
    int descriptor_;
};

Descriptor openToRead(const std::filesystem::path& path) {
    Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (descriptor.get() < 0) failIo(path.string(), "read");
    return descriptor;
}

/// Returns the size in bytes, or 0 if the file is not a regular one.
uint64_t regularSize(const Descriptor& descriptor, const std::string& name) {
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0) failIo(name, "read");
    return S_ISREG(status.st_mode) ? uint64_t(status.st_size) : 0;
}

/// Maps a range of the file, which must not be empty. Returns nullptr if the system cannot map it. A mapping
/// starts at a page, so it may start before the range.
std::unique_ptr<ByteSource> mapRange(const Descriptor& descriptor, uint64_t offset, uint64_t length,
                                     const std::string& name) {
    const auto page = uint64_t(::sysconf(_SC_PAGESIZE));
    const auto before = size_t(offset % page);
    const size_t mapped = size_t(length) + before;
    void* data = ::mmap(nullptr, mapped, PROT_READ, MAP_PRIVATE, descriptor.get(), off_t(offset - before));
    if (data == MAP_FAILED) return nullptr;
    std::shared_ptr<const void> mapping(data, [mapped](void* p) { ::munmap(p, mapped); });
    const std::span bytes(static_cast<const std::byte*>(data) + before, size_t(length));
    return std::make_unique<ViewedSource>(std::move(mapping), bytes, name);
}

}  // namespace

std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path) {
    if (path == "-") return streamSource(STDIN_FILENO, "standard input");
    const std::string name = path.string();
    Descriptor descriptor = openToRead(path);
    const uint64_t size = regularSize(descriptor, name);
    if (size > 0)
        if (auto mapped = mapRange(descriptor, 0, size, name)) return mapped;
    return std::make_unique<StreamSource>(std::move(descriptor), name);
}

std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path, uint64_t offset, uint64_t length) {
    const std::string name = path.string();
    const Descriptor descriptor = openToRead(path);
    const uint64_t size = regularSize(descriptor, name);
    if (offset >= size || length > size - offset)
        throw Error(ErrorKind::invalid, name + ": the range from byte " + std::to_string(offset) +
                                            (length > 0 ? " of " + std::to_string(length) + " bytes" : "") +
                                            " is not within the file's " + std::to_string(size) + " bytes");
    auto mapped = mapRange(descriptor, offset, length > 0 ? length : size - offset, name);
    if (!mapped) failIo(name, "mapped");
    return mapped;
}

std::unique_ptr<ByteSource> viewSource(std::span<const std::byte> bytes, const std::string& name) {
    return std::make_unique<ViewedSource>(nullptr, bytes, name);
}

std::unique_ptr<ByteSource> memorySource(std::span<const std::byte> bytes, const std::string& name) {
    return std::make_unique<MemorySource>(bytes, name);
}

std::unique_ptr<ByteSource> streamSource(int descriptor, const std::string& name) {
    return std::make_unique<StreamSource>(descriptor, name);
}

}  // namespace bvhio
