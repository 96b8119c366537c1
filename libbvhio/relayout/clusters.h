// Clusters for records with short pointers (see tree/clusters.h for the paper and the method). The order of
// pairs is the order of their records' slots.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// Records have 8 bytes; options.recordBytes is ignored. Lines have at most 512 bytes.
LayoutResult layoutClusters(const Bvh& bvh, const LayoutOptions& options);
LayoutResult layoutClustersAsPaper(const Bvh& bvh, const LayoutOptions& options);

/// Returns the tree in the order of a layout, with its clusters.
Bvh applyLayout(const Bvh& bvh, const LayoutResult& layout);

}  // namespace bvhio
