// Other orders of a scene's triangles and vertices, for files: coders of geometry ask that neighbours stand
// beside each other.
#pragma once

#include <span>

#include "scene/scene.h"

namespace bvhio {

/// The same triangles over vertices in the order in which triangles name them first; behind them those that
/// none names.
Scene withVerticesByUse(const Scene& scene);

struct ReorderedScene {
    Scene scene;
    std::vector<uint32_t> newIndex;  // of each triangle, by its old one
};

/// Each geometry's triangles in the order in which `entries`, such as a tree's leaf order, names them first:
/// each at least once. They keep their ids, by sourcePrimitives.
ReorderedScene withTrianglesInOrder(const Scene& scene, std::span<const uint32_t> entries);

}  // namespace bvhio
