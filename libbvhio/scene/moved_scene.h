// The same mesh in another pose.
#pragma once

#include "scene/scene.h"

namespace bvhio {

/// The triangles of `old`, in its order, with the vertices that they have in `moved`: a scene of the same
/// geometries, whose triangles are joined alike and may lie elsewhere. Vertices may be numbered otherwise.
/// Triangles that `old` dropped, or has in another order, are known by their source numbers; `moved` must
/// have all of its source's. Throws Error{invalid} that names the first difference when the scenes are not
/// the same mesh.
Scene movedScene(const Scene& old, const Scene& moved);

}  // namespace bvhio
