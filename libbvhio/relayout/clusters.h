// Clusters for records with short pointers (tree/clusters.h has the paper and the method): the order of pairs
// is the order of their records' slots.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// Records have 8 bytes, whatever options.recordBytes says; lines at most 512.
LayoutResult layoutClusters(const Bvh& bvh, const LayoutOptions& options);
LayoutResult layoutClustersAsPaper(const Bvh& bvh, const LayoutOptions& options);

/// The tree in the order of a layout, and in its clusters.
Bvh applyLayout(const Bvh& bvh, const LayoutResult& layout);

}  // namespace bvhio
