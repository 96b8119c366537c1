#include "core/buffer.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace bvhio {

std::shared_ptr<void> allocateUncleared(size_t bytes) {
    constexpr size_t kLine = 64, kHugePage = size_t(2) << 20;
    const size_t alignment = bytes >= 2 * kHugePage ? kHugePage : kLine;
    // aligned_alloc wants a multiple of the alignment, which huge pages need anyway; the tail stays
    // untouched.
    void* memory = std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    // Advice only: where it is refused, small pages do.
    if (alignment == kHugePage) (void)madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
    return {memory, [](void* p) { std::free(p); }};
}

}  // namespace bvhio
