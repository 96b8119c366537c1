// Treelets, each depth first.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// What LayoutOptions::threshold is unless it was given. Treelets are not limited in size.
inline constexpr double kTdfsThreshold = 0.5;

LayoutResult layoutTdfs(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
