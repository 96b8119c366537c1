// The default builder: binned SAH.
#pragma once

#include "build/builders.h"
#include "build/reference.h"

namespace bvhio {

inline constexpr uint32_t kMaxBins = 256;

/// Throws Error{usage} if options.bins is 1 or above kMaxBins.
void checkBins(const BuildOptions& options);

/// Builds a tree over the scene's triangles. Throws as checkBins does.
Bvh buildBinned(const Scene& scene, const BuildOptions& options);

/// Builds a tree over any boxes, with one box in each leaf. Its primitives are those of the references.
Bvh buildBinnedOver(Buffer<Reference> references, const Box& bounds, const SahCosts& costs);

}  // namespace bvhio
