// An order of lines of connected pairs, which are grouped into pages.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutPack(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
