#include "core/buffer.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace bvhio {

std::shared_ptr<void> allocateUncleared(size_t bytes) {
    constexpr size_t kLine = 64, kHugePage = size_t(2) << 20;
    const size_t alignment = bytes >= 2 * kHugePage ? kHugePage : kLine;
    // aligned_alloc needs a multiple of the alignment, and so do huge pages. The tail is never touched, so it
    // takes no memory.
    void* memory = std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    // This is only advice. Where the system refuses it, small pages work too.
    if (alignment == kHugePage) (void)madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
    return {memory, [](void* p) { std::free(p); }};
}

}  // namespace bvhio
