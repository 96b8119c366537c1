// The container of format-spec/container.md: a signature, a header, chunks with checksums, and END. It knows
// nothing of BVHs.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "container/byte_source.h"
#include "container/codecs.h"
#include "core/findings.h"

namespace bvhio {

/// The version of the format that this library writes, and the newest that it reads.
inline constexpr uint16_t kFormatMajor = 1, kFormatMinor = 0;

/// Returns a chunk's type as the u32 of its four bytes, as in `chunkType("NODE")`.
constexpr uint32_t chunkType(const char (&name)[5]) {
    uint32_t type = 0;
    for (int i = 0; i < 4; ++i) type |= uint32_t(static_cast<unsigned char>(name[i])) << (8 * i);
    return type;
}
std::string chunkTypeName(uint32_t type);

/// Flags of a chunk.
inline constexpr uint32_t kCritical = 1, kSurvivesReorder = 2, kSurvivesTopologyChange = 4;

inline constexpr uint32_t kEndType = chunkType("END ");
inline constexpr uint32_t kProvenanceType =
    chunkType("PROV");  // named here because the content hash leaves it out

/// A chunk header as it stands in the file.
struct ChunkHeader {
    uint32_t type = 0;
    uint32_t flags = 0;
    uint32_t codec = 0;
    uint64_t rawSize = 0;
    uint64_t storedSize = 0;
    uint64_t checksum = 0;  // digest of the stored payload
    uint64_t offset = 0;    // of the header in the file

    uint64_t payloadOffset() const { return offset + 64; }
};

/// Computes the hash of a file's content from its chunks, in file order.
class ContentHash {
  public:
    void add(const ChunkHeader& header, uint64_t rawDigest);
    uint64_t value() const;

  private:
    std::vector<uint64_t> records_;
};

/// How much of a file its reader checks. In a trusted file it skips the checksums, the content hash
/// and every check that visits all elements of an array. Trust only files that this machine has
/// checked or written before: a damaged file makes a trusting reader access memory outside its
/// arrays.
enum class Trust { checked, trusted };

/// Reads a container front to back. Checks all clauses R10xx, unless the file is trusted, and throws
/// FindingError at the first one that is broken.
class ContainerReader {
  public:
    /// Reads the file's header.
    explicit ContainerReader(ByteSource& source, Trust trust = Trust::checked);

    /// Returns the next chunk's header, or nothing after a valid END chunk, which ends the file.
    std::optional<ChunkHeader> nextHeader();
    /// Returns the decoded payload of that chunk. It is a view into the file if the file is mapped and the
    /// codec is none.
    Bytes payload();
    /// Reads and checks the rest of the container.
    void drain();
    /// Skips the payload without decoding it, and returns whether its checksum matched. END is then not
    /// checked.
    bool skipPayload();

    /// Throws FindingError about the chunk that was read last.
    [[noreturn]] void fail(FindingId id, const std::string& message) const;
    const std::string& name() const { return source_.name(); }
    const ChunkHeader& lastHeader() const { return header_; }
    /// Returns every chunk header read so far, in file order.
    const std::vector<ChunkHeader>& headers() const { return headers_; }
    bool isTrusted() const { return trust_ == Trust::trusted; }
    /// Returns the content hash that END states, or 0 until END was read.
    uint64_t contentHash() const { return contentHash_; }

  private:
    Bytes takeStored();
    void checkEnd(const Bytes& payload);

    ByteSource& source_;
    Trust trust_;
    ChunkHeader header_;
    std::vector<ChunkHeader> headers_;
    ContentHash hash_;
    uint64_t chunks_ = 0;
    uint64_t contentHash_ = 0;
    bool pending_ = false;  // a header was read, but not its payload yet
    bool skipped_ = false;
};

/// Writes a container front to back. The stream need not be seekable. Throws Error{io} if the stream
/// fails.
class ContainerWriter {
  public:
    /// Writes the file's header. `level` 0 means the codec's default level.
    ContainerWriter(std::ostream& out, const Codec& codec, int level);

    void write(uint32_t type, uint32_t flags, std::span<const std::byte> payload,
               Numbers numbers = Numbers::none);
    /// Writes END, flushes the stream, and returns the content hash.
    uint64_t finish();

  private:
    void writeChunk(uint32_t type, uint32_t flags, std::span<const std::byte> payload,
                    const std::optional<EncodedPayload>& encoded);
    void put(std::span<const std::byte> bytes);

    std::ostream& out_;
    const Codec& codec_;
    int level_;
    ContentHash hash_;
    uint64_t chunks_ = 0;
    uint64_t written_ = 0;
};

}  // namespace bvhio
