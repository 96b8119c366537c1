#include "trace/simd_target.h"

#include <hwy/targets.h>

namespace bvhio {

std::string simdTarget() {
    const int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable);  // better targets have lower bits
}

}  // namespace bvhio
