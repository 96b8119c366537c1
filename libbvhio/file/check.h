// The functions of `bvh-stats --check` and `--chunks`: all faults of a file, and its chunks.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "container/container.h"
#include "core/findings.h"

namespace bvhio {

/// Returns all faults of a file, from the container over its chunks and the tree's structure to geometry, as
/// far as earlier faults allow. At most 8 findings of a kind, by family. "-" is standard input. Throws
/// Error{io} if the file cannot be read.
std::vector<Finding> checkFile(const std::filesystem::path& path);
std::vector<Finding> checkBytes(std::span<const std::byte> bytes, const std::string& name);

struct ListedChunk {
    ChunkHeader header;
    std::string type;
    std::string name;   // the content of this type, or "unknown" for a type that this version does not know
    std::string codec;  // by name
    bool checksumMatches = false;
};

struct ChunkList {
    std::vector<ListedChunk> chunks;
    std::optional<Finding> stop;  // the finding that ended the list, if any
};

/// Lists the chunks of a file, even of a damaged one, as far as its chunk headers are valid. Payloads are not
/// decoded.
ChunkList listChunks(const std::filesystem::path& path);
ChunkList listChunks(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
