// Finds a scene's triangles in another pose of the same mesh, for refits.
#pragma once

#include "scene/scene.h"

namespace bvhio {

/// Returns the triangles of `old`, in its order, with the vertices that they have in `moved`. Both scenes
/// must have the same geometries, and their triangles must share vertices in the same way; numbers and
/// positions of vertices may differ. If `old` dropped or reordered triangles, they are found by their source
/// numbers, so `moved` must have all triangles of its source. Throws Error{invalid} that names the first
/// difference if the scenes are not the same mesh.
Scene movedScene(const Scene& old, const Scene& moved);

}  // namespace bvhio
