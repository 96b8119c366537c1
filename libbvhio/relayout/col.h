// A cache-oblivious order by probabilities.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutCol(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
