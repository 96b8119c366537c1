// Trees over an instanced scene.
#pragma once

#include "build/builders.h"
#include "scene/instanced_bvh.h"

namespace bvhio {

/// A tree over each mesh's triangles, and one over the boxes of the instances with one of them in each leaf,
/// all by the same builder; but where that cuts triangles, the top is by buildBinned, since instances cannot
/// be cut. Options are for meshes' trees; progress counts their triangles.
InstancedBvh buildInstanced(const Scene& scene, const Builder& builder, const BuildOptions& options);

}  // namespace bvhio
