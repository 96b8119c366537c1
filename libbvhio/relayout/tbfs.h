// Treelets, each breadth first.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// What LayoutOptions::threshold is unless it was given. Treelets have at most as many pairs as a line has
/// records.
inline constexpr double kTbfsThreshold = 0.5;

LayoutResult layoutTbfs(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
