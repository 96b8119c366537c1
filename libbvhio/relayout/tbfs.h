// An order of treelets, each in breadth-first order.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

/// The default of LayoutOptions::threshold. By default, treelets have at most as many pairs as a line has
/// records.
inline constexpr double kTbfsThreshold = 0.5;

LayoutResult layoutTbfs(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
