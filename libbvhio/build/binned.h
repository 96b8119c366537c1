// The default builder: binned SAH.
#pragma once

#include "build/builders.h"

namespace bvhio {

inline constexpr uint32_t kMaxBins = 256;

/// Throws Error{usage} when options.bins is 1 or above kMaxBins.
void checkBins(const BuildOptions& options);

/// Throws as checkBins does.
Bvh buildBinned(const Scene& scene, const BuildOptions& options);

}  // namespace bvhio
