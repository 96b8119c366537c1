// The chunks of a scene (format-spec/chunks.md 2 to 6), and the check of what they hold.
#pragma once

#include "file/chunks.h"
#include "scene/scene.h"
#include "tree/validate.h"

namespace bvhio {

/// A scene as a file gives it back, and its Draco data when it is stored so.
struct StoredScene {
    Scene scene;
    std::vector<std::byte> draco;
};

/// Encodes a scene: with Draco, vertices move to where they will be decoded, and into the order that the
/// options say; triangles and their order stay.
StoredScene storeScene(const Scene& scene, const WriteOptions& options);
void writeScene(ContainerWriter& writer, const StoredScene& stored);

/// Reads a scene that keeps every promise of scene/scene.h; throws FindingError otherwise.
Scene readScene(ChunkSequence& chunks);

/// The boxes of the scene's triangles, for `validate` and `refit`. The scene must outlive it.
PrimitiveBounds boundsOfTriangles(const Scene& scene);

}  // namespace bvhio
