// An order of treelets, each in depth-first order.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// The default of LayoutOptions::threshold. By default, the size of treelets is not limited.
inline constexpr double kTdfsThreshold = 0.5;

LayoutResult layoutTdfs(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
