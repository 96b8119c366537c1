#include "tree/depth.h"

#include <algorithm>

namespace bvhio {

std::vector<uint32_t> depthsOfPairs(const Bvh& bvh) {
    std::vector<uint32_t> depths(bvh.nodes.size() / 2);
    for (size_t i = 0; i < bvh.nodes.size(); ++i)
        if (i != 1 && !bvh.nodes[i].isLeaf()) depths[bvh.nodes[i].left() / 2] = depths[i / 2] + 1;
    return depths;
}

uint32_t depthOf(const Bvh& bvh) {
    const std::vector<uint32_t> depths = depthsOfPairs(bvh);
    return depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

}  // namespace bvhio
