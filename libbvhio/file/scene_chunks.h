// The chunks of a scene (format-spec/chunks.md 2 to 6), and the check of what they hold.
#pragma once

#include "core/validate.h"
#include "file/chunks.h"
#include "scene/scene.h"

namespace bvhio {

void writeScene(ContainerWriter& writer, const Scene& scene);

/// Reads a scene; throws FindingError unless it keeps every promise of scene/scene.h.
Scene readScene(ChunkSequence& chunks);

/// Checks coordinates and indices in parallel: at most `maxPerId` findings of each of the kinds 40xx.
std::vector<Finding> checkScene(const Scene& scene, size_t maxPerId);

/// The boxes of the scene's triangles, for `validate` and `refit`. The scene must outlive it.
PrimitiveBounds boundsOfTriangles(const Scene& scene);

}  // namespace bvhio
