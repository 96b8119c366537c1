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
    throw Error(ErrorKind::io, name + ": cannot " + what + ": " + std::strerror(errno));
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

/// A mapped file. The mapping lives as long as any array that views it.
class MappedSource : public ByteSource {
  public:
    MappedSource(std::shared_ptr<const void> mapping, std::span<const std::byte> bytes,
                 const std::string& name)
        : ByteSource(name), mapping_(std::move(mapping)), bytes_(bytes) {}

  private:
    Bytes takeNext(uint64_t count) override {
        const auto part = bytes_.first(size_t(std::min<uint64_t>(count, bytes_.size())));
        bytes_ = bytes_.subspan(part.size());
        return {mapping_, part};
    }

    std::shared_ptr<const void> mapping_;
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

}  // namespace

std::unique_ptr<ByteSource> openSource(const std::filesystem::path& path) {
    if (path == "-") return streamSource(STDIN_FILENO, "standard input");
    const std::string name = path.string();
    Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (descriptor.get() < 0) failIo(name, "open");
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0) failIo(name, "stat");
    if (!S_ISREG(status.st_mode) || status.st_size == 0)
        return std::make_unique<StreamSource>(std::move(descriptor), name);

    const auto size = size_t(status.st_size);
    void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.get(), 0);
    if (data == MAP_FAILED) return std::make_unique<StreamSource>(std::move(descriptor), name);
    std::shared_ptr<const void> mapping(data, [size](void* p) { ::munmap(p, size); });
    return std::make_unique<MappedSource>(mapping, std::span(static_cast<const std::byte*>(data), size),
                                          name);
}

std::unique_ptr<ByteSource> memorySource(std::span<const std::byte> bytes, const std::string& name) {
    return std::make_unique<MemorySource>(bytes, name);
}

std::unique_ptr<ByteSource> streamSource(int descriptor, const std::string& name) {
    return std::make_unique<StreamSource>(descriptor, name);
}

}  // namespace bvhio
