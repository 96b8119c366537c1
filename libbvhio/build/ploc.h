// Agglomerative clustering in parallel rounds.
#pragma once

#include "build/builders.h"

namespace bvhio {

Bvh buildPloc(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
