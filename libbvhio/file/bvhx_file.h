// A whole .bvhx file as an object, read from and written to streams in one pass.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compress/forms.h"
#include "scene/scene.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// One step of a file's history: which tool made it, with which options. Left out of the content hash.
struct ProvenanceEntry {
    std::string tool;     // "bvh-build"
    std::string version;  // of the tools, "0.1.0"
    std::string options;  // as JSON, with defaults filled in
    bool operator==(const ProvenanceEntry&) const = default;
};

/// A chunk whose type this version does not know, kept byte for byte so that a pass can hand it on.
struct UnknownChunk {
    uint32_t type;
    uint32_t flags;
    std::vector<std::byte> payload;  // decoded
};

/// The content of a file. After `readBvhx` it is fully valid: nothing needs to be checked again.
struct BvhxFile {
    Scene scene;
    EncodedBvh bvh;
    SahCosts costs;  // what the tree was built for
    std::vector<ProvenanceEntry> provenance;
    std::vector<UnknownChunk> unknownChunks;
    /// How many of some rays fetched each pair of nodes (trace/visits.h), for a tree in the aabb form; empty
    /// where that was not recorded.
    SharedArray<uint32_t> visits{};
};

enum class GeometryEncoding { raw, draco };
/// Nodes as the form has them, or their topology alone: reading it back fits the same boxes to the triangles.
enum class NodeEncoding { plain, topology };

/// Vertices as they are, or with Draco in whichever order is smaller: that or the one in which triangles name
/// them.
enum class VertexOrder { kept, smaller };

struct WriteOptions {
    std::string codec = "none";  // a row of codecs()
    int codecLevel = 0;          // 0 = the codec's default
    NodeEncoding nodes = NodeEncoding::plain;
    GeometryEncoding geometry = GeometryEncoding::raw;
    int dracoPositionBits = 16;
    VertexOrder dracoVertices = VertexOrder::kept;
};

/// Reads a file: mapped when `path` is a regular file, so that arrays stored with codec none are used in
/// place; "-" is standard input. A mapped file must not be cut or overwritten in place while the object
/// lives: the kernel would end the process with SIGBUS, as with any map. Replacing it by renaming another
/// over it, as the tools do, is safe. Throws Error: io, invalid (damaged; chunk and byte named), unsupported
/// (newer major version, unknown critical chunk).
BvhxFile readBvhx(const std::filesystem::path& path);
/// Reads from memory, copying what it keeps.
BvhxFile readBvhx(std::span<const std::byte> bytes, const std::string& name);

/// Writes in one pass to a stream that need not be seekable. Throws Error: invalid, before anything is
/// written, where the scene breaks a promise of scene/scene.h, or where the tree is not over its triangles;
/// usage where nodes of the tree's form can't be stored as options.nodes says. Returns the tree as written
/// where that is not file.bvh: refitted to geometry that was stored with losses.
std::optional<EncodedBvh> writeBvhx(std::ostream& out, const BvhxFile& file, const WriteOptions& options);

/// What a pass did to a tree.
enum class Change { reordered, topologyChanged };

/// Drops visits, and the unknown chunks that are wrong after such a pass, as their flags say; a pass calls it
/// before it writes. A change of form counts as a reorder; a restructured tree may be reordered too, so a
/// pass that does both calls it for both.
void dropChunksThatDoNotSurvive(BvhxFile& file, Change change);

}  // namespace bvhio
