// The boxes of a scene's triangles, as checks and refits of trees ask for them.
#pragma once

#include "scene/scene.h"
#include "tree/validate.h"

namespace bvhio {

/// Returns a function that computes boxes of the scene's triangles, for `validate` and `refit`. The scene
/// must outlive it.
PrimitiveBounds boundsOfTriangles(const Scene& scene);

}  // namespace bvhio
