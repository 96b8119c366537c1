// Saves containers, and computes their costs.
#include <cstdlib>
#include <cstring>
#include <ostream>

#include "api/content.h"
#include "api/status.h"
#include "core/parallel.h"
#include "file/safe_file.h"
#include "stats/tree_stats.h"

namespace bvhio {
namespace {

constexpr size_t kAlignment = 64;  // so that arrays can be used in place

/// A stream buffer over memory that grows. release() returns the memory to the caller.
class GrowingMemory : public std::streambuf {
  public:
    ~GrowingMemory() override { std::free(bytes_); }
    void* release() { return std::exchange(bytes_, nullptr); }
    size_t size() const { return size_; }

  protected:
    int_type overflow(int_type c) override {
        const char character = traits_type::to_char_type(c);
        append(&character, 1);
        return traits_type::not_eof(c);
    }
    std::streamsize xsputn(const char* data, std::streamsize size) override {
        append(data, size_t(size));
        return size;
    }

  private:
    void append(const char* data, size_t size) {
        if (size > capacity_ - size_) grow(size_ + size);
        std::memcpy(bytes_ + size_, data, size);
        size_ += size;
    }
    void grow(size_t needed) {
        const size_t capacity = (std::max(needed, 2 * capacity_) + kAlignment - 1) / kAlignment * kAlignment;
        auto* const larger = static_cast<char*>(std::aligned_alloc(kAlignment, capacity));
        if (larger == nullptr) throw std::bad_alloc();
        if (size_ > 0) std::memcpy(larger, bytes_, size_);
        std::free(bytes_);
        bytes_ = larger;
        capacity_ = capacity;
    }

    char* bytes_ = nullptr;
    size_t size_ = 0, capacity_ = 0;
};

void write(std::ostream& out, const BvhioContainer* container, const BvhioContext* context) {
    out.exceptions(std::ios::badbit);  // so that exceptions of the buffer reach the caller
    const Content& content = contentOf(container);
    const ThreadLimit limit(context == nullptr ? 0 : context->threads);
    writeBvhx(out, content.file, content.writing);
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

BvhioStatus bvhioSaveFile(const BvhioContainer* container, const char* path, const BvhioContext* context) {
    return guarded([&] {
        requirePointer(container, "container");
        requirePointer(path, "path");
        const std::string target = regularTarget(path);
        if (target.empty()) throw Error(ErrorKind::io, std::string(path) + ": is not a regular file");
        SafeFile file(target, path);
        write(file.stream(), container, context);
        file.commit(Durability::synced);
    });
}

BvhioStatus bvhioSaveMemory(const BvhioContainer* container, const BvhioContext* context, void** bytes,
                            size_t* size) {
    return guarded([&] {
        requirePointer(bytes, "bytes");
        *bytes = nullptr;
        requirePointer(size, "size");
        *size = 0;
        requirePointer(container, "container");
        GrowingMemory memory;
        std::ostream out(&memory);
        write(out, container, context);
        *size = memory.size();
        *bytes = memory.release();
    });
}

void bvhioFree(void* bytes) {
    std::free(bytes);
}

BvhioStatus bvhioGetCost(const BvhioContainer* container, double* cost) {
    return guarded([&] {
        requirePointer(container, "container");
        requirePointer(cost, "cost");
        const BvhxFile& file = contentOf(container).file;
        *cost = sahCost(file.scene, file.bvh, file.costs);
    });
}
}
