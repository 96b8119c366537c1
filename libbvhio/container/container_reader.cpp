#include <algorithm>

#include "container/container.h"
#include "container/container_format.h"
#include "container/digest.h"
#include "core/buffer.h"
#include "core/bytes.h"
#include "core/hash.h"

namespace bvhio {
namespace {

uint64_t checksumOf(const Bytes& header) {
    return hash64(std::span<const std::byte>(header).first(kCheckedSize));
}

bool isTypeByte(unsigned char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == ' ';
}

std::string version(unsigned major, unsigned minor) {
    return std::to_string(major) + "." + std::to_string(minor);
}

constexpr auto kErrorSeverity = Finding::Severity::error;

}  // namespace

ContainerReader::ContainerReader(ByteSource& source, Trust trust) : source_(source), trust_(trust) {
    const auto failHeader = [&](FindingId id, uint64_t offset, const std::string& message) {
        throw FindingError(name(), {id, kErrorSeverity, message, "", offset, kNowhere});
    };

    // The signature, as far as the file has bytes.
    const Bytes bytes = source_.take(kHeaderSize);
    const size_t compared = std::min(bytes.size(), kSignature.size());
    const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
    if (!std::equal(begin, begin + compared, kSignature.begin()))
        failHeader(FindingId::signature, 0, "not a .bvhx file, or damaged by a transfer as text");
    if (bytes.size() < kHeaderSize)
        failHeader(FindingId::cut, bytes.size(),
                   bytes.empty() ? "the input is empty" : "the file ends within its header: it was cut");

    // The fields. The checksum comes first: the other checks would only report consequences of damage.
    ByteReader reader(bytes, "header");
    reader.bytes(kSignature.size());
    const unsigned major = reader.u16(), minor = reader.u16(), readerMajor = reader.u16(),
                   readerMinor = reader.u16();
    const bool zero = reader.skipZeros(kCheckedSize - reader.position());
    if (reader.u64() != checksumOf(bytes))
        failHeader(FindingId::headerChecksum, 0, "the header's checksum does not match: the file is damaged");
    if (major > kFormatMajor)
        failHeader(FindingId::newerMajor, 12,
                   "format version " + version(major, minor) + " is newer than " +
                       version(kFormatMajor, kFormatMinor) + ": use a newer bvhx");
    if (major == 0 || std::pair(readerMajor, readerMinor) > std::pair(major, minor))
        failHeader(FindingId::versionOrder, 12,
                   "format version " + version(major, minor) + " cannot require a reader of version " +
                       version(readerMajor, readerMinor));
    if (std::pair<unsigned, unsigned>(kFormatMajor, kFormatMinor) < std::pair(readerMajor, readerMinor))
        failHeader(FindingId::newerReader, 16,
                   "the file requires a reader of version " + version(readerMajor, readerMinor) +
                       ": use a newer bvhx");
    if (!zero) failHeader(FindingId::headerReserved, 20, "a reserved byte of the header is not zero");
}

void ContainerReader::fail(FindingId id, const std::string& message) const {
    throw FindingError(name(),
                       {id, kErrorSeverity, message, chunkTypeName(header_.type), header_.offset, kNowhere});
}

std::optional<ChunkHeader> ContainerReader::nextHeader() {
    if (header_.type == kEndType) return std::nullopt;
    header_ = {};
    const uint64_t offset = source_.position();
    const Bytes bytes = source_.take(kHeaderSize);
    const auto failHere = [&](FindingId id, const std::string& message) {
        throw FindingError(name(), {id, kErrorSeverity, message, "", offset, kNowhere});
    };
    if (bytes.empty()) failHere(FindingId::cut, "the file ends without an END chunk: it was cut");
    if (bytes.size() < kHeaderSize)
        failHere(FindingId::cut, "the file ends within a chunk header: it was cut");

    // The fields, and the checksum over them.
    ByteReader reader(bytes, "chunk header");
    ChunkHeader header;
    header.offset = offset;
    header.type = reader.u32();
    header.flags = reader.u32();
    header.codec = reader.u32();
    bool zero = reader.skipZeros(4);
    header.rawSize = reader.u64();
    header.storedSize = reader.u64();
    header.checksum = reader.u64();
    zero &= reader.skipZeros(16);
    if (reader.u64() != checksumOf(bytes))
        failHere(FindingId::chunkHeaderChecksum,
                 "the chunk header's checksum does not match: the file is damaged");
    const auto* type = reinterpret_cast<const unsigned char*>(bytes.data());
    if (!std::all_of(type, type + 4, isTypeByte))
        failHere(FindingId::chunkType, "the chunk's type is not four letters, digits or spaces");

    // From here on messages name the chunk.
    header_ = header;
    pending_ = true;
    if (!zero || header.flags > (kCritical | kSurvivesReorder | kSurvivesTopologyChange))
        fail(FindingId::chunkReserved, "a reserved field or flag of the chunk header is not zero");
    const Codec* codec = findCodec(header.codec);
    if (!codec)
        fail(FindingId::unknownCodec, "unknown codec " + std::to_string(header.codec) + ": use a newer bvhx");
    const bool sane = header.codec == 0
                          ? header.rawSize == header.storedSize
                          : header.rawSize > 0 && header.rawSize <= kMaxPayload &&
                                header.storedSize >= (header.rawSize + kMaxExpansion - 1) / kMaxExpansion;
    if (!sane || header.storedSize > kMaxPayload)
        fail(FindingId::chunkSizes, "stored size " + std::to_string(header.storedSize) + " and raw size " +
                                        std::to_string(header.rawSize) + " are not possible with codec " +
                                        std::string(codec->name));
    headers_.push_back(header_);
    return header_;
}

Bytes ContainerReader::takeStored() {
    pending_ = false;
    Bytes stored = source_.take(header_.storedSize);
    if (stored.size() < header_.storedSize)
        fail(FindingId::cut, "the file ends after " + std::to_string(stored.size()) + " of the payload's " +
                                 std::to_string(header_.storedSize) + " bytes: it was cut");
    const size_t paddingSize = paddingAfter(header_.storedSize);
    const Bytes padding = source_.take(paddingSize);
    if (padding.size() < paddingSize)
        fail(FindingId::cut, "the file ends within the padding of the payload: it was cut");
    if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; }))
        fail(FindingId::padding, "a padding byte after the payload is not zero");
    return stored;
}

bool ContainerReader::skipPayload() {
    skipped_ = true;
    return digest(takeStored()) == header_.checksum;
}

Bytes ContainerReader::payload() {
    const Bytes stored = takeStored();
    const uint64_t storedDigest = isTrusted() ? header_.checksum : digest(stored);
    if (storedDigest != header_.checksum)
        fail(FindingId::payloadChecksum, "the payload's checksum does not match: the file is damaged");
    Bytes raw = stored;
    if (header_.codec != 0) {
        Buffer<std::byte> decoded(header_.rawSize);
        if (!findCodec(header_.codec)->function.decode(stored, {decoded.data(), decoded.size()}))
            fail(FindingId::codecPayload, "the payload does not decode");
        raw = std::move(decoded).share();
    }
    if (header_.type == kEndType) {
        checkEnd(raw);
    } else {
        ++chunks_;
        if (!isTrusted()) hash_.add(header_, header_.codec == 0 ? storedDigest : digest(raw));
    }
    return raw;
}

void ContainerReader::checkEnd(const Bytes& payload) {
    if (header_.flags != kCritical || header_.codec != 0 || header_.rawSize != kEndSize)
        fail(FindingId::endForm, "the END chunk has the wrong flags, codec or size");
    ByteReader reader(payload, "chunk END");
    const uint64_t hash = reader.u64(), chunks = reader.u64(), fileSize = reader.u64();
    if (!reader.skipZeros(8)) fail(FindingId::endForm, "END's reserved field is not zero");
    contentHash_ = hash;
    if (skipped_) return;
    if (chunks != chunks_ || fileSize != source_.position())
        fail(FindingId::endTotals, "END counts " + std::to_string(chunks) + " chunks and " +
                                       std::to_string(fileSize) + " bytes, but the file has " +
                                       std::to_string(chunks_) + " and " +
                                       std::to_string(source_.position()));
    if (!isTrusted() && hash != hash_.value())
        fail(FindingId::contentHash, "the content hash does not match");
    if (!source_.take(1).empty()) fail(FindingId::trailingBytes, "bytes follow the END chunk");
}

void ContainerReader::drain() {
    if (pending_) payload();
    while (nextHeader()) payload();
}

}  // namespace bvhio
