// Breadth-first order.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutBfs(const Bvh& bvh, const LayoutOptions&);

}  // namespace bvhio
