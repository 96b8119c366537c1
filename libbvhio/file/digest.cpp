#include "file/digest.h"

#include <xxhash.h>

#include <vector>

#include "core/parallel.h"

namespace bvhio {

uint64_t xxh3(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t digest(std::span<const std::byte> bytes) {
    std::vector<uint64_t> hashes((bytes.size() + kBlockSize - 1) / kBlockSize);
    parallelChunks(bytes.size(), kBlockSize, [&](size_t begin, size_t end) {
        hashes[begin / kBlockSize] = xxh3(bytes.subspan(begin, end - begin));
    });
    return xxh3(std::as_bytes(std::span(hashes)));
}

}  // namespace bvhio
