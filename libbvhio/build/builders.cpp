#include "build/builders.h"

#include "build/median.h"

namespace bvhio {

std::span<const Builder> builders() {
    static constexpr Builder kTable[] = {
        {"median", "object median along the longest axis; no SAH, the plainest tree", buildMedian},
    };
    return kTable;
}

}  // namespace bvhio
