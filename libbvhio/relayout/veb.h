// Van Emde Boas order.
#pragma once

#include "relayout/layouts.h"

namespace bvhio {

LayoutResult layoutVeb(const Bvh& bvh, const LayoutOptions& options);

}  // namespace bvhio
