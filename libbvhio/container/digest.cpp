#include "container/digest.h"

#include <vector>

#include "core/hash.h"
#include "core/parallel.h"

namespace bvhio {

uint64_t digest(std::span<const std::byte> bytes) {
    std::vector<uint64_t> hashes((bytes.size() + kBlockSize - 1) / kBlockSize);
    parallelChunks(bytes.size(), kBlockSize, [&](size_t begin, size_t end) {
        hashes[begin / kBlockSize] = hash64(bytes.subspan(begin, end - begin));
    });
    return hash64(std::as_bytes(std::span(hashes)));
}

}  // namespace bvhio
