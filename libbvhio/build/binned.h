// The default builder: binned SAH.
#pragma once

#include "build/builders.h"
#include "build/reference.h"

namespace bvhio {

inline constexpr uint32_t kMaxBins = 256;

/// Throws Error{usage} when options.bins is 1 or above kMaxBins.
void checkBins(const BuildOptions& options);

/// Throws as checkBins does.
Bvh buildBinned(const Scene& scene, const BuildOptions& options);

/// The tree over any boxes, with one in each leaf; its primitives are the references'.
Bvh buildBinnedOver(Buffer<Reference> references, const Box& bounds, const SahCosts& costs);

}  // namespace bvhio
