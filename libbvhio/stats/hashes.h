// Hashes that show what two trees or scenes have in common, for any order of their nodes in memory.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// Returns for each node a hash of its subtree's topology: which triangles are grouped in which way; 0 in the
/// unused slot. A hash does not depend on the order of the nodes in memory, of the children of a node, or of
/// the triangles in a leaf (a layout may change these), nor on boxes. Triangles enter by their index in
/// Scene::triangles.
std::vector<uint64_t> topologyHashes(const Bvh& bvh);
/// Returns hashes of topology and boxes together.
std::vector<uint64_t> boundsHashes(const Bvh& bvh);

/// Return the root's hashes. Equal topology hashes mean that no pass has restructured the tree, and equal
/// bounds hashes that no pass has changed a box.
inline uint64_t topologyHash(const Bvh& bvh) {
    return topologyHashes(bvh)[0];
}
inline uint64_t boundsHash(const Bvh& bvh) {
    return boundsHashes(bvh)[0];
}

/// Returns a hash of all data of a scene: vertices, triangles, geometries with their names, and source
/// primitive numbers, each as stored and in order.
uint64_t geometryHash(const Scene& scene);

}  // namespace bvhio
