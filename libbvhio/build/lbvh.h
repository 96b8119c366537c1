// The fastest builder: the order of Morton codes is the tree.
#pragma once

#include "build/builders.h"

namespace bvhio {

Bvh buildLbvh(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
