// SAH over every plane between centroids.
#pragma once

#include "build/builders.h"

namespace bvhio {

Bvh buildSweep(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
