// Depth-first order.
#pragma once

#include "relayout/node_order.h"

namespace bvhio {

NodeOrder orderDepthFirst(const Bvh& bvh);

}  // namespace bvhio
