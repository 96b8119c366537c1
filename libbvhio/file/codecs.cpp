// Zstandard (RFC 8878), as one independent frame for each block of 1 MiB: blocks are coded by several
// threads, and the bytes are the same for any number of them.

#include "file/codecs.h"

#include <zstd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "core/parallel.h"
#include "file/digest.h"

namespace bvhio {
namespace {

std::optional<AlignedVector<std::byte>> encodeNone(std::span<const std::byte>, int) {
    return std::nullopt;
}

bool decodeNone(std::span<const std::byte> stored, std::span<std::byte> raw) {
    if (stored.size() != raw.size()) return false;
    std::copy(stored.begin(), stored.end(), raw.begin());
    return true;
}

std::optional<AlignedVector<std::byte>> encodeZstd(std::span<const std::byte> raw, int level) {
    std::vector<std::vector<std::byte>> frames((raw.size() + kBlockSize - 1) / kBlockSize);
    parallelChunks(raw.size(), kBlockSize, [&](size_t begin, size_t end) {
        const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
        if (!context) throw std::bad_alloc();
        auto& frame = frames[begin / kBlockSize];
        frame.resize(ZSTD_compressBound(end - begin));
        const size_t size = ZSTD_compressCCtx(context.get(), frame.data(), frame.size(), raw.data() + begin,
                                              end - begin, level);
        if (ZSTD_isError(size))
            throw Error(ErrorKind::resources, std::string("zstd: ") + ZSTD_getErrorName(size));
        frame.resize(size);
        frame.shrink_to_fit();
    });
    size_t total = 0;
    for (const auto& frame : frames) total += frame.size();
    if (total >= raw.size() || raw.size() > total * kMaxExpansion) return std::nullopt;
    AlignedVector<std::byte> stored;
    stored.reserve(total);
    for (const auto& frame : frames) stored.insert(stored.end(), frame.begin(), frame.end());
    return stored;
}

bool decodeZstd(std::span<const std::byte> stored, std::span<std::byte> raw) {
    // Walking the frames' block headers finds where each one starts, and proves that each decodes to its
    // block's size at most.
    std::vector<std::span<const std::byte>> frames;
    const size_t blocks = (raw.size() + kBlockSize - 1) / kBlockSize;
    for (size_t block = 0; block < blocks; ++block) {
        // Only RFC 8878's own magic number: the library may know older formats as well.
        constexpr std::byte kMagic[] = {std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}};
        if (stored.size() < 4 || !std::equal(kMagic, kMagic + 4, stored.begin())) return false;
        const size_t size = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        if (ZSTD_isError(size)) return false;
        if (ZSTD_getFrameContentSize(stored.data(), size) !=
            std::min(kBlockSize, raw.size() - block * kBlockSize))
            return false;
        frames.push_back(stored.first(size));
        stored = stored.subspan(size);
    }
    if (!stored.empty()) return false;

    std::atomic<bool> good = true;
    parallelChunks(raw.size(), kBlockSize, [&](size_t begin, size_t end) {
        const auto frame = frames[begin / kBlockSize];
        const size_t size = ZSTD_decompress(raw.data() + begin, end - begin, frame.data(), frame.size());
        if (size != end - begin) good = false;
    });
    return good;
}

}  // namespace

std::span<const Codec> codecs() {
    static const Codec kTable[] = {
        {"none",
         "store as is; usable from a memory map without copying",
         {0, 0, 0, 0, encodeNone, decodeNone}},
        {"zstd", "Zstandard; levels 1 (fast) to 19 (small)", {1, 3, 1, 19, encodeZstd, decodeZstd}},
    };
    return kTable;
}

const Codec* findCodec(uint32_t id) {
    for (const Codec& codec : codecs())
        if (codec.function.id == id) return &codec;
    return nullptr;
}

}  // namespace bvhio
