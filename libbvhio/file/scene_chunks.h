// Reads, checks and writes the chunks of a scene (format-spec/chunks.md 2 to 6).
#pragma once

#include "file/chunks.h"
#include "file/write_options.h"
#include "scene/scene.h"

namespace bvhio {

/// A scene as a reader of the file will decode it, and its Draco data if it is stored with Draco.
struct StoredScene {
    Scene scene;
    std::vector<std::byte> draco;
};

/// Encodes a scene. With Draco, vertices move to their decoded positions, and into the order of the options.
/// Triangles and their order do not change.
StoredScene storeScene(const Scene& scene, const WriteOptions& options);
void writeScene(ContainerWriter& writer, const StoredScene& stored);

/// Reads a scene that keeps all rules of scene/scene.h. Throws FindingError if it breaks one.
Scene readScene(ChunkSequence& chunks);

}  // namespace bvhio
