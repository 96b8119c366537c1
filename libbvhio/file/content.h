// What follows a file's header, for those who open the container themselves.
#pragma once

#include "container/container.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// Reads everything behind a file's header. With `collected`, findings about content gather there, and what
/// is returned may be used only when there are none.
BvhxFile readContent(ContainerReader& container, std::vector<Finding>* collected = nullptr);

}  // namespace bvhio
