// Reorders a scene's triangles and vertices for files, because coders of geometry need neighbours to be next
// to each other.
#pragma once

#include <span>

#include "scene/scene.h"

namespace bvhio {

/// Returns the same triangles over vertices in the order of first use by triangles. Unused vertices come
/// last.
Scene withVerticesByUse(const Scene& scene);

struct ReorderedScene {
    Scene scene;
    std::vector<uint32_t> newIndex;  // of each triangle, by its old one
};

/// Returns the scene with each geometry's triangles in the order of their first use in `entries`, such as a
/// tree's leaf order, which must contain each triangle. They keep their ids, by sourcePrimitives.
ReorderedScene withTrianglesInOrder(const Scene& scene, std::span<const uint32_t> entries);

}  // namespace bvhio
