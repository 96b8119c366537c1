// The table of layouts: orders of a tree's nodes in memory. Layouts change neither the tree nor its cost.
#pragma once

#include "core/choice.h"
#include "relayout/node_order.h"

namespace bvhio {

/// A layout's order depends on the tree alone: not on the order its nodes had before, so applying a layout
/// twice is applying it once.
using Layout = Choice<NodeOrder (*)(const Bvh&)>;

/// All layouts, the default first.
std::span<const Layout> layouts();

}  // namespace bvhio
