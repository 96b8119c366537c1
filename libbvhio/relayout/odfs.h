// Depth-first order with the likelier subtree first.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutOdfs(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
