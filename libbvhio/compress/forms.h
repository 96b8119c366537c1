// THE list of forms. A new form is its own file and one line here.
#pragma once

#include <variant>

#include "compress/aabb_form.h"

namespace bvhio {

using EncodedBvh = std::variant<AabbForm>;

}  // namespace bvhio
