// The known chunks (format-spec/chunks.md): the table of their types, and reading them in order.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "container/container.h"
#include "core/findings.h"
#include "core/shared_array.h"
#include "file/unknown_chunk.h"
#include "scene/scene.h"

namespace bvhio {

inline constexpr uint32_t kSceneType = chunkType("SCEN");
inline constexpr uint32_t kVerticesType = chunkType("VERT");
inline constexpr uint32_t kTrianglesType = chunkType("TRIS");
inline constexpr uint32_t kDracoType = chunkType("DRCO");
inline constexpr uint32_t kGeometriesType = chunkType("GEOM");
inline constexpr uint32_t kSourcePrimitivesType = chunkType("SRCP");
inline constexpr uint32_t kMeshesType = chunkType("MESH");
inline constexpr uint32_t kInstancesType = chunkType("INST");
inline constexpr uint32_t kTreeType = chunkType("TREE");
inline constexpr uint32_t kFormType = chunkType("FORM");
inline constexpr uint32_t kNodesType = chunkType("NODE");
inline constexpr uint32_t kEntriesType = chunkType("ENTR");
inline constexpr uint32_t kTlasType = chunkType("TLAS");
inline constexpr uint32_t kRootsType = chunkType("ROOT");
inline constexpr uint32_t kBlasType = chunkType("BLAS");
inline constexpr uint32_t kPrimitivesType = chunkType("PRIM");
inline constexpr uint32_t kTopologyType = chunkType("TOPO");
inline constexpr uint32_t kVisitsType = chunkType("VISI");
inline constexpr uint32_t kLastEntriesType = chunkType("LAST");
inline constexpr uint32_t kClustersType = chunkType("CLUS");

/// A row of the table of known chunks.
struct ChunkKind {
    uint32_t type;
    uint32_t flags;
    std::string_view name;
};

/// Returns every known type, in the order in which chunks appear in a file. END is last.
std::span<const ChunkKind> chunkKinds();
/// Returns the row of a type, or nullptr.
const ChunkKind* findChunkKind(uint32_t type);

/// Writes a chunk of known type with its flags.
void writeChunk(ContainerWriter& writer, uint32_t type, std::span<const std::byte> payload,
                Numbers numbers = Numbers::none);
template <class T>
void writeArrayChunk(ContainerWriter& writer, uint32_t type, const SharedArray<T>& array) {
    constexpr bool kTriples = std::is_same_v<T, Vec3> || std::is_same_v<T, TriangleIndices>;
    constexpr Numbers kNumbers = kTriples                      ? Numbers::triples
                                 : std::is_same_v<T, uint32_t> ? Numbers::single
                                                               : Numbers::none;
    writeChunk(writer, type, std::as_bytes(std::span<const T>(array)), kNumbers);
}

/// Reads known chunks in the order in which the caller asks for them, and collects the unknown ones between.
class ChunkSequence {
  public:
    /// Findings about a payload's content are appended to `collected`. Without it, the first one is thrown.
    explicit ChunkSequence(ContainerReader& reader, std::vector<Finding>* collected = nullptr)
        : reader_(reader), collected_(collected) {}

    /// Returns the payload of the next known chunk. Throws FindingError unless the chunk is of this type and
    /// the payload has `size` bytes, or any size with kAnySize.
    Bytes expect(uint32_t type, uint64_t size);
    template <class T>
    SharedArray<T> expectArray(uint32_t type, uint64_t count) {
        const Bytes bytes = expect(type, count * sizeof(T));
        return {bytes.owner(), {reinterpret_cast<const T*>(bytes.data()), size_t(count)}};
    }
    /// Returns whether the next known chunk is of this type.
    bool nextIs(uint32_t type);
    /// Throws FindingError about the chunk that was read last.
    [[noreturn]] void fail(FindingId id, const std::string& message) const { reader_.fail(id, message); }
    /// Takes findings about a payload that starts at byte `payload`, where their offsets count from. Collects
    /// all of them, or throws the first.
    void addFindings(std::vector<Finding> findings, uint64_t payload);
    /// Returns whether all content read so far is valid: true unless findings were collected.
    bool sound() const { return !collected_ || collected_->empty(); }
    /// Returns whether the file is trusted, so that no check may visit all elements.
    bool isTrusted() const { return reader_.isTrusted(); }
    /// Returns how many findings of one kind a check should look for.
    size_t maxPerId() const { return collected_ ? 8 : 1; }
    /// Returns where in the file the payload starts that was read last.
    uint64_t payloadOffset() const { return reader_.lastHeader().payloadOffset(); }
    /// Returns the unknown ancillary chunks that were skipped, and forgets them.
    std::vector<UnknownChunk> takeUnknown() { return std::move(unknown_); }

    static constexpr uint64_t kAnySize = ~uint64_t(0);

  private:
    const ChunkHeader& peek();

    ContainerReader& reader_;
    std::vector<Finding>* collected_;
    std::optional<ChunkHeader> next_;
    std::vector<uint32_t> seen_;
    std::vector<UnknownChunk> unknown_;
};

}  // namespace bvhio
