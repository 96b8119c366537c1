// Lines of connected pairs, grouped into pages.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutPack(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
