// Hashes that tell what two trees or scenes have in common, however their nodes lie in memory.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// For each node, a hash of which triangles its subtree groups how; 0 in the unused slot. It is the same for
/// any order of the nodes in memory, of the two children of a node and of the triangles in a leaf (a layout
/// may swap any of them), and it sees no boxes. Triangles count by their index in Scene::triangles.
std::vector<uint64_t> topologyHashes(const Bvh& bvh);
/// The same of grouping and boxes together.
std::vector<uint64_t> boundsHashes(const Bvh& bvh);

/// The root's hashes: equal topologies mean that no pass has restructured the tree; equal bounds, that none
/// has changed a box.
inline uint64_t topologyHash(const Bvh& bvh) {
    return topologyHashes(bvh)[0];
}
inline uint64_t boundsHash(const Bvh& bvh) {
    return boundsHashes(bvh)[0];
}

/// A hash of all that a scene says: vertices, triangles, geometries with their names, and source primitive
/// numbers, each as stored and in order.
uint64_t geometryHash(const Scene& scene);

}  // namespace bvhio
