// The canonical tree of an instanced scene: one over its instances, and one over each of its meshes.
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

struct InstancedBvh {
    Bvh top;                  // its primitives are instances, and its leaves have one each
    std::vector<Bvh> meshes;  // primitives count from the mesh's first triangle
};

/// A mesh as a plain scene of its own, in its own space; it shares the scene's vertices.
Scene sceneOfMesh(const Scene& scene, const SceneMesh& mesh);

/// A plain scene that has a triangle for each instance, whose box is the instance's in the world: for what
/// builds and changes trees.
Scene sceneOfInstances(const Scene& scene);

/// Applies a function to each tree and the scene that it is over: `function(scene, tree, isTop)`.
InstancedBvh mapTrees(const Scene& scene, const InstancedBvh& bvh,
                      const std::function<Bvh(const Scene&, const Bvh&, bool isTop)>& function);

}  // namespace bvhio
