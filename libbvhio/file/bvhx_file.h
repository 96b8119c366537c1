// A whole .bvhx file as an object, read from and written to streams in one pass.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compress/forms.h"
#include "file/unknown_chunk.h"
#include "file/write_options.h"
#include "scene/scene.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// One step of a file's history: the tool that made it, and its options. The content hash leaves it out.
struct ProvenanceEntry {
    std::string tool;     // "bvh-build"
    std::string version;  // of the tools, "0.1.0"
    std::string options;  // as JSON, with defaults filled in
    bool operator==(const ProvenanceEntry&) const = default;
};

/// The content of a file. What `readBvhx` returns is fully valid: nothing needs to be checked again.
struct BvhxFile {
    Scene scene;
    EncodedBvh bvh;
    SahCosts costs;  // that the tree was built for
    std::vector<ProvenanceEntry> provenance;
    std::vector<UnknownChunk> unknownChunks;
    /// How many of the recorded rays fetched each pair of nodes (trace/visits.h). Only for a tree in the aabb
    /// form; empty if no visits were recorded.
    SharedArray<uint32_t> visits{};
};

/// Reads a file; "-" is standard input. A regular file is mapped, and arrays stored with codec none are used
/// in place. A mapped file must not be cut or overwritten in place while the object lives: the kernel would
/// end the process with SIGBUS, as with any map. Renaming another file over it, as the tools do, is safe.
/// Throws Error: io; invalid if the file is damaged, with the chunk and the byte; unsupported for a newer
/// major version or an unknown critical chunk.
BvhxFile readBvhx(const std::filesystem::path& path);
/// Reads from memory, and copies what it keeps.
BvhxFile readBvhx(std::span<const std::byte> bytes, const std::string& name);

/// Writes in one pass to a stream that need not be seekable. Returns the written tree if it is not file.bvh:
/// a tree is refitted to geometry that is stored with losses. Throws Error: invalid, before anything is
/// written, if the scene breaks a rule of scene/scene.h or the tree is not over its triangles; usage if nodes
/// of the tree's form cannot be stored as options.nodes asks.
std::optional<EncodedBvh> writeBvhx(std::ostream& out, const BvhxFile& file, const WriteOptions& options);

/// What a pass did to a tree.
enum class Change { reordered, topologyChanged };

/// Drops visits, and the unknown chunks whose flags say that they do not survive such a pass. A pass calls it
/// before it writes. A change of form counts as a reorder. A restructured tree may be reordered too: a pass
/// that does both calls it for both.
void dropChunksThatDoNotSurvive(BvhxFile& file, Change change);

}  // namespace bvhio
