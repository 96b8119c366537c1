// How passes change the trees of a file's content.
#pragma once

#include <functional>

#include "file/bvhx_file.h"

namespace bvhio {

/// Replaces the file's tree, or each tree of an instanced scene, by the tree that `function` returns for it,
/// in the aabb form. `isTop` marks the tree over the instances; its scene has one triangle in each instance's
/// box.
using TreeFunction = std::function<Bvh(const Scene&, const Bvh&, bool isTop)>;
void changeTrees(BvhxFile& file, const TreeFunction& function);

}  // namespace bvhio
