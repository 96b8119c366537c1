// How passes change the trees of a file's content.
#pragma once

#include <functional>

#include "file/bvhx_file.h"

namespace bvhio {

/// Both levels of an instanced scene as they are built: in the aabb form.
EncodeOptions exactLevels();

/// Puts what the function makes of the container's tree in its place, in the aabb form; in an instanced scene
/// that of each tree, `isTop` for the one over the instances, whose scene has a triangle in each instance's
/// box.
using TreeFunction = std::function<Bvh(const Scene&, const Bvh&, bool isTop)>;
void changeTrees(BvhxFile& file, const TreeFunction& function);

}  // namespace bvhio
