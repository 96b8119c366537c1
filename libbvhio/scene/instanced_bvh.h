// The canonical trees of an instanced scene: one over its instances, and one over each of its meshes.
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

struct InstancedBvh {
    Bvh top;                  // its primitives are instances, and each leaf has one
    std::vector<Bvh> meshes;  // primitives are numbered from the mesh's first triangle
};

/// Returns a mesh as a plain scene, in the mesh's own space. It shares the scene's vertices.
Scene sceneOfMesh(const Scene& scene, const SceneMesh& mesh);

/// Returns a plain scene with a triangle for each instance, whose bounds are the instance's box in the world.
/// It lets builders, restructurers and layouts work on trees of instances.
Scene sceneOfInstances(const Scene& scene);

/// Applies `function(scene, tree, isTop)` to each tree and its scene, and returns the resulting trees.
InstancedBvh mapTrees(const Scene& scene, const InstancedBvh& bvh,
                      const std::function<Bvh(const Scene&, const Bvh&, bool isTop)>& function);

}  // namespace bvhio
