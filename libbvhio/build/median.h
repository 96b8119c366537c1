// The simplest builder: object median splits.
#pragma once

#include "build/builders.h"

namespace bvhio {

Bvh buildMedian(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
