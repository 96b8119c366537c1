// Checks that a scene keeps all rules of scene/scene.h.
#pragma once

#include <vector>

#include "core/findings.h"
#include "scene/scene.h"

namespace bvhio {

/// Check coordinates and indices, in parallel. Each returns at most `maxPerId` findings of each kind, with
/// offsets from the array's start and without a chunk.
std::vector<Finding> checkVertices(const Scene& scene, size_t maxPerId);
std::vector<Finding> checkTriangles(const Scene& scene, size_t maxPerId);

/// Throws an Error about the first fault of the scene: invalid, or unsupported if a count is beyond what the
/// format can hold. Every pass can work on a scene that passes, and every reader can read it back. O(n),
/// parallel.
void checkScene(const Scene& scene);

}  // namespace bvhio
