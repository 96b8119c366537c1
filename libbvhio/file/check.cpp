#include "file/check.h"

#include <algorithm>

#include "file/chunks.h"
#include "file/content.h"

namespace bvhio {
namespace {

/// Adds warnings: odd properties of a scene that are not faults of the file.
void addWarnings(const Scene& scene, std::vector<Finding>& findings) {
    const auto warn = [&](FindingId id, size_t count, const std::string& what) {
        if (count > 0)
            findings.push_back(
                {id, Finding::Severity::warning, std::to_string(count) + what, "", kNowhere, kNowhere});
    };
    std::vector<bool> used(scene.vertices.size());
    size_t degenerate = 0;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const TriangleIndices& t = scene.triangles[i];
        used[t.v0] = used[t.v1] = used[t.v2] = true;
        if (area(scene.triangle(i)) == 0) ++degenerate;
    }
    const auto unused = size_t(std::count(used.begin(), used.end(), false));
    warn(FindingId::degenerateTriangles, degenerate, " triangles have zero area");
    warn(FindingId::unusedVertices, unused, " vertices belong to no triangle");
}

std::vector<Finding> check(ByteSource& source) {
    std::vector<Finding> findings;
    std::optional<ContainerReader> container;
    try {
        container.emplace(source);
        const BvhxFile file = readContent(*container, &findings);
        if (findings.empty()) addWarnings(file.scene, findings);
    } catch (const FindingError& error) {
        findings.push_back(error.finding());
        // If the content is invalid, the container may be valid, or have findings of its own.
        if (error.finding().id >= FindingId::unknownCriticalChunk) try {
                container->drain();
            } catch (const FindingError& later) {
                findings.push_back(later.finding());
            }
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
        return uint32_t(a.id) / 1000 < uint32_t(b.id) / 1000;
    });
    return findings;
}

ChunkList listChunks(ByteSource& source) {
    ChunkList list;
    try {
        ContainerReader container(source);
        while (const auto header = container.nextHeader()) {
            const ChunkKind* kind = findChunkKind(header->type);
            list.chunks.push_back({*header, chunkTypeName(header->type),
                                   std::string(kind ? kind->name : "unknown"),
                                   std::string(findCodec(header->codec)->name), false});
            list.chunks.back().checksumMatches = container.skipPayload();
        }
    } catch (const FindingError& error) {
        list.stop = error.finding();
    }
    return list;
}

}  // namespace

std::vector<Finding> checkFile(const std::filesystem::path& path) {
    return check(*openSource(path));
}

std::vector<Finding> checkBytes(std::span<const std::byte> bytes, const std::string& name) {
    return check(*memorySource(bytes, name));
}

ChunkList listChunks(const std::filesystem::path& path) {
    return listChunks(*openSource(path));
}

ChunkList listChunks(std::span<const std::byte> bytes, const std::string& name) {
    return listChunks(*memorySource(bytes, name));
}

}  // namespace bvhio
