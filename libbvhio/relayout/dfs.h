// Depth-first order.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutDfs(const Bvh& bvh, const LayoutOptions&);

}  // namespace bvhio
