// Zstandard (RFC 8878), with one independent frame for each block of 1 MiB. So several threads can code
// blocks, and the bytes are the same for any number of threads. Arrays of numbers are first split into bytes
// of equal significance, if that helps.

#include "container/codecs.h"

#include <zstd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "container/digest.h"
#include "core/parallel.h"

namespace bvhio {
namespace {

constexpr uint32_t kMagic = 0xFD2FB528;  // the first bytes of a frame

std::optional<AlignedVector<std::byte>> encodeNone(std::span<const std::byte>, int) {
    return std::nullopt;
}

bool decodeNone(std::span<const std::byte> stored, std::span<std::byte> raw) {
    if (stored.size() != raw.size()) return false;
    std::copy(stored.begin(), stored.end(), raw.begin());
    return true;
}

/// Returns the number of bytes before the blocks of a frame without a dictionary (RFC 8878, 3.1.1.1).
size_t headerSize(std::span<const std::byte> frame) {
    const auto descriptor = uint32_t(frame[4]);
    const uint32_t singleSegment = descriptor >> 5 & 1, contentSizeFlag = descriptor >> 6;
    const uint32_t contentSize = contentSizeFlag == 0 ? singleSegment : 1u << contentSizeFlag;
    return 5 + (1 - singleSegment) + contentSize;
}

std::vector<std::byte> compressed(std::span<const std::byte> raw, int level) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    if (!context) throw std::bad_alloc();
    std::vector<std::byte> frame(ZSTD_compressBound(raw.size()));
    const size_t size =
        ZSTD_compressCCtx(context.get(), frame.data(), frame.size(), raw.data(), raw.size(), level);
    if (ZSTD_isError(size))
        throw Error(ErrorKind::resources, std::string("zstd: ") + ZSTD_getErrorName(size));
    frame.resize(size);
    return frame;
}

/// Compresses a block of the payload into a frame. If the frame would expand more than readers accept, it
/// begins with a raw block that is just large enough to prevent that.
std::vector<std::byte> frameOf(std::span<const std::byte> block, int level) {
    std::vector<std::byte> frame = compressed(block, level);
    if (block.size() <= frame.size() * kMaxExpansion) return frame;
    const size_t plain = (block.size() + kMaxExpansion - 1) / kMaxExpansion;
    const auto byteOf = [](size_t number, int i) { return std::byte(number >> 8 * i); };
    std::vector<std::byte> result;
    for (int i = 0; i < 4; ++i) result.push_back(byteOf(kMagic, i));
    result.push_back(std::byte{0xA0});  // a single segment, its size in four bytes
    for (int i = 0; i < 4; ++i) result.push_back(byteOf(block.size(), i));
    for (int i = 0; i < 3; ++i) result.push_back(byteOf(plain << 3, i));  // not the last block; raw
    frame = compressed(block.subspan(plain), level);
    const auto blocks = std::span<const std::byte>(frame).subspan(headerSize(frame));
    result.insert(result.end(), block.begin(), block.begin() + ptrdiff_t(plain));
    result.insert(result.end(), blocks.begin(), blocks.end());
    return result;
}

/// Compresses all blocks of a payload into frames. `prepare(block, buffer)` may change each block first.
/// Returns nothing if the frames are not smaller than the payload.
template <class Prepare>
std::optional<AlignedVector<std::byte>> encodeBlocks(std::span<const std::byte> raw, int level,
                                                     const Prepare& prepare) {
    std::vector<std::vector<std::byte>> frames((raw.size() + kBlockSize - 1) / kBlockSize);
    parallelChunks(raw.size(), kBlockSize, [&](size_t begin, size_t end) {
        std::vector<std::byte> buffer;
        auto& frame = frames[begin / kBlockSize];
        frame = frameOf(prepare(raw.subspan(begin, end - begin), buffer), level);
        frame.shrink_to_fit();
    });
    size_t total = 0;
    for (const auto& frame : frames) total += frame.size();
    if (total >= raw.size()) return std::nullopt;
    AlignedVector<std::byte> stored;
    stored.reserve(total);
    for (const auto& frame : frames) stored.insert(stored.end(), frame.begin(), frame.end());
    return stored;
}

/// Finds where each frame starts by walking the frames' block headers. This also proves that each frame
/// decodes to at most its block's size. Returns nothing if the frames do not match a payload of `rawSize`
/// bytes.
std::optional<std::vector<std::span<const std::byte>>> framesOf(std::span<const std::byte> stored,
                                                                size_t rawSize) {
    std::vector<std::span<const std::byte>> frames;
    const size_t blocks = (rawSize + kBlockSize - 1) / kBlockSize;
    for (size_t block = 0; block < blocks; ++block) {
        // Accept only the magic number of RFC 8878: the library may also know older formats.
        if (stored.size() < sizeof kMagic || std::memcmp(stored.data(), &kMagic, sizeof kMagic) != 0)
            return std::nullopt;
        const size_t size = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        if (ZSTD_isError(size)) return std::nullopt;
        if (ZSTD_getFrameContentSize(stored.data(), size) !=
            std::min(kBlockSize, rawSize - block * kBlockSize))
            return std::nullopt;
        frames.push_back(stored.first(size));
        stored = stored.subspan(size);
    }
    if (!stored.empty()) return std::nullopt;
    return frames;
}

bool decodeFrame(std::span<const std::byte> frame, std::span<std::byte> block) {
    return ZSTD_decompress(block.data(), block.size(), frame.data(), frame.size()) == block.size();
}

std::optional<AlignedVector<std::byte>> encodeZstd(std::span<const std::byte> raw, int level) {
    return encodeBlocks(raw, level, [](std::span<const std::byte> block, auto&) { return block; });
}

bool decodeZstd(std::span<const std::byte> stored, std::span<std::byte> raw) {
    const auto frames = framesOf(stored, raw.size());
    if (!frames) return false;
    std::atomic<bool> good = true;
    parallelChunks(raw.size(), kBlockSize, [&](size_t begin, size_t end) {
        if (!decodeFrame((*frames)[begin / kBlockSize], raw.subspan(begin, end - begin))) good = false;
    });
    return good;
}

/// Replaces each number of a block by its difference to the number `Stride` before it, with the sign folded
/// into the lowest bit. Stores all lowest bytes of the differences first, then all second bytes, and so on.
/// Numbers close to their neighbours leave mostly zeros.
template <size_t Stride>
std::optional<AlignedVector<std::byte>> encodeDifferences(std::span<const std::byte> raw, int level) {
    if (raw.size() % 4 != 0) return std::nullopt;
    return encodeBlocks(raw, level, [](std::span<const std::byte> block, std::vector<std::byte>& buffer) {
        const size_t count = block.size() / 4;
        buffer.resize(block.size());
        uint32_t before[Stride] = {};
        for (size_t i = 0; i < count; ++i) {
            uint32_t number = 0;
            std::memcpy(&number, &block[4 * i], 4);
            const uint32_t difference = number - before[i % Stride];
            before[i % Stride] = number;
            const uint32_t folded = difference << 1 ^ (difference >> 31 != 0 ? ~0u : 0);
            for (size_t plane = 0; plane < 4; ++plane)
                buffer[plane * count + i] = std::byte(folded >> 8 * plane);
        }
        return std::span<const std::byte>(buffer);
    });
}

template <size_t Stride>
bool decodeDifferences(std::span<const std::byte> stored, std::span<std::byte> raw) {
    const auto frames = framesOf(stored, raw.size());
    if (!frames || raw.size() % 4 != 0) return false;
    std::atomic<bool> good = true;
    parallelChunks(raw.size(), kBlockSize, [&](size_t begin, size_t end) {
        const size_t count = (end - begin) / 4;
        std::vector<std::byte> buffer(end - begin);
        if (!decodeFrame((*frames)[begin / kBlockSize], buffer)) good = false;
        uint32_t before[Stride] = {};
        for (size_t i = 0; i < count; ++i) {
            uint32_t folded = 0;
            for (size_t plane = 0; plane < 4; ++plane)
                folded |= uint32_t(buffer[plane * count + i]) << 8 * plane;
            const uint32_t number = before[i % Stride] + (folded >> 1 ^ ((folded & 1) != 0 ? ~0u : 0));
            before[i % Stride] = number;
            std::memcpy(&raw[begin + 4 * i], &number, 4);
        }
    });
    return good;
}

const Codec kDifferenceCodecs[] = {
    {"zstd-numbers",
     "Zstandard of each number's difference to the one before",
     {2, 3, 1, 19, encodeDifferences<1>, decodeDifferences<1>}},
    {"zstd-triples",
     "Zstandard of each number's difference to the third before",
     {3, 3, 1, 19, encodeDifferences<3>, decodeDifferences<3>}},
};

}  // namespace

std::span<const Codec> codecs() {
    static const Codec kTable[] = {
        {"none",
         "no compression: arrays are used from the mapped file without copying",
         {0, 0, 0, 0, encodeNone, decodeNone}},
        {"zstd", "Zstandard compression", {1, 3, 1, 19, encodeZstd, decodeZstd}},
    };
    return kTable;
}

const Codec* findCodec(uint32_t id) {
    for (const std::span<const Codec> table : {codecs(), std::span<const Codec>(kDifferenceCodecs)})
        for (const Codec& codec : table)
            if (codec.function.id == id) return &codec;
    return nullptr;
}

std::optional<EncodedPayload> encodePayload(const Codec& codec, int level, std::span<const std::byte> raw,
                                            Numbers numbers) {
    std::optional<EncodedPayload> best;
    const auto consider = [&](const Codec& candidate) {
        auto bytes = candidate.function.encode(raw, level);
        if (bytes && (!best || bytes->size() < best->bytes.size()))
            best = {candidate.function.id, std::move(*bytes)};
    };
    if (raw.empty()) return best;
    consider(codec);
    if (codec.function.encode == encodeZstd && numbers != Numbers::none)
        consider(kDifferenceCodecs[numbers == Numbers::triples]);
    return best;
}

}  // namespace bvhio
