#include <algorithm>
#include <ostream>

#include "container/container.h"
#include "container/container_format.h"
#include "container/digest.h"
#include "core/bytes.h"
#include "core/hash.h"

namespace bvhio {

std::string chunkTypeName(uint32_t type) {
    std::string name;
    for (int i = 0; i < 4; ++i) name += char(type >> (8 * i));
    return name;
}

void ContentHash::add(const ChunkHeader& header, uint64_t rawDigest) {
    if (header.type == kProvenanceType) return;
    records_.push_back(uint64_t(header.flags) << 32 | header.type);
    records_.push_back(header.rawSize);
    records_.push_back(rawDigest);
}

uint64_t ContentHash::value() const {
    return hash64(std::as_bytes(std::span(records_)));
}

ContainerWriter::ContainerWriter(std::ostream& out, const Codec& codec, int level)
    : out_(out), codec_(codec), level_(level == 0 ? codec.function.defaultLevel : level) {
    if (level_ != 0 && codec.function.maxLevel == 0)
        throw Error(ErrorKind::usage,
                    "codec " + std::string(codec.name) + " has no levels: leave the level out");
    if (level_ < codec.function.minLevel || level_ > codec.function.maxLevel)
        throw Error(ErrorKind::usage, "codec " + std::string(codec.name) + " has no level " +
                                          std::to_string(level_) + ": use " +
                                          std::to_string(codec.function.minLevel) + " to " +
                                          std::to_string(codec.function.maxLevel));
    ByteWriter header;
    for (const unsigned char c : kSignature) header.string({reinterpret_cast<const char*>(&c), 1});
    header.u16(kFormatMajor);
    header.u16(kFormatMinor);
    header.u16(kFormatMajor);  // the oldest reader that can read the file: nothing here is newer than 1.0
    header.u16(0);
    header.zeros(kCheckedSize - header.bytes().size());
    header.u64(hash64(header.bytes()));
    put(header.bytes());
}

void ContainerWriter::write(uint32_t type, uint32_t flags, std::span<const std::byte> payload,
                            Numbers numbers) {
    writeChunk(type, flags, payload, encodePayload(codec_, level_, payload, numbers));
    ++chunks_;
}

void ContainerWriter::writeChunk(uint32_t type, uint32_t flags, std::span<const std::byte> payload,
                                 const std::optional<EncodedPayload>& encoded) {
    const std::span<const std::byte> stored = encoded ? std::span<const std::byte>(encoded->bytes) : payload;

    const uint64_t rawDigest = digest(payload);
    ByteWriter header;
    header.u32(type);
    header.u32(flags);
    header.u32(encoded ? encoded->codec : 0);
    header.zeros(4);
    header.u64(payload.size());
    header.u64(stored.size());
    header.u64(encoded ? digest(stored) : rawDigest);
    header.zeros(16);
    header.u64(hash64(header.bytes()));
    put(header.bytes());
    put(stored);
    static constexpr std::array<std::byte, 64> kZeros{};
    put(std::span(kZeros).first(paddingAfter(stored.size())));
    hash_.add({.type = type, .flags = flags, .rawSize = payload.size()}, rawDigest);
}

uint64_t ContainerWriter::finish() {
    const uint64_t hash = hash_.value();
    ByteWriter end;
    end.u64(hash);
    end.u64(chunks_);
    end.u64(written_ + 2 * kHeaderSize);  // with END's header and its padded payload
    end.zeros(8);
    writeChunk(kEndType, kCritical, end.bytes(), std::nullopt);
    out_.flush();
    if (!out_) throw Error(ErrorKind::io, "cannot write the output");
    return hash;
}

void ContainerWriter::put(std::span<const std::byte> bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!out_) throw Error(ErrorKind::io, "cannot write the output");
    written_ += bytes.size();
}

}  // namespace bvhio
