// Trees over an instanced scene.
#pragma once

#include "build/builders.h"
#include "scene/instanced_bvh.h"

namespace bvhio {

/// Builds a tree over the triangles of each mesh, and a tree over the boxes of the instances, with one
/// instance in each leaf. All trees are by the same builder, except that buildBinned replaces a builder that
/// cuts triangles for the top tree, since instances cannot be cut. The options are for the trees of meshes,
/// and progress counts their triangles.
InstancedBvh buildInstanced(const Scene& scene, const Builder& builder, const BuildOptions& options);

}  // namespace bvhio
