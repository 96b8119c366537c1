// What `bvh-stats --check` and `--chunks` look at: all that is wrong with a file, and the chunks it has.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "container/container.h"
#include "core/findings.h"

namespace bvhio {

/// Everything that is wrong with a file, from the container over its chunks and the tree's structure to
/// geometry, as far as what is broken lets one look; at most 8 of a kind, by family. "-" is standard input.
/// Throws Error{io} when it cannot be read.
std::vector<Finding> checkFile(const std::filesystem::path& path);
std::vector<Finding> checkBytes(std::span<const std::byte> bytes, const std::string& name);

struct ListedChunk {
    ChunkHeader header;
    std::string type;
    std::string name;   // what the type holds, "unknown" for a type that this version does not know
    std::string codec;  // by name
    bool checksumMatches = false;
};

struct ChunkList {
    std::vector<ListedChunk> chunks;
    std::optional<Finding> stop;  // what made it impossible to go on, if anything
};

/// The chunks of a file, even of one whose content is damaged, as far as its chunk headers hold. Payloads are
/// not decoded.
ChunkList listChunks(const std::filesystem::path& path);
ChunkList listChunks(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
