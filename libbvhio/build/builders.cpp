#include "build/builders.h"

#include "build/binned.h"
#include "build/median.h"

namespace bvhio {

std::span<const Builder> builders() {
    static constexpr Builder kTable[] = {
        {"binned", "binned SAH on all threads: fast, and good trees", buildBinned},
        {"median", "object median along the longest axis; no SAH, the plainest tree", buildMedian},
    };
    return kTable;
}

}  // namespace bvhio
