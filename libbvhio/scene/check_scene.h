// Checks every promise that scene/scene.h makes.
#pragma once

#include <vector>

#include "core/findings.h"
#include "scene/scene.h"

namespace bvhio {

/// Checks coordinates, or indices, in parallel: returns at most `maxPerId` findings of each kind, with
/// offsets from the array's start and no chunk.
std::vector<Finding> checkVertices(const Scene& scene, size_t maxPerId);
std::vector<Finding> checkTriangles(const Scene& scene, size_t maxPerId);

/// Throws unless the scene is valid, an Error that names the first thing that is wrong: invalid, or
/// unsupported where a count is beyond what the format can hold. What it lets pass every pass can work on and
/// every reader reads back. O(n), parallel.
void checkScene(const Scene& scene);

}  // namespace bvhio
