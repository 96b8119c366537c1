// Names the instruction set that tracing uses, for reports.
#pragma once

#include <string>

namespace bvhio {

/// Highway's name of the best target that this library was compiled for and that the processor has: "AVX2".
std::string simdTarget();

}  // namespace bvhio
