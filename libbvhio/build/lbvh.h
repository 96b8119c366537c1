// The fastest builder: the tree follows from the order of Morton codes alone.
#pragma once

#include "build/builders.h"

namespace bvhio {

Bvh buildLbvh(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
