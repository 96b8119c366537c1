#include "relayout/pair_weights.h"

#include <algorithm>

namespace bvhio {

PairWeights weightsByArea(const Bvh& bvh) {
    PairWeights weights(bvh.nodes.size() / 2, 1);
    const double root = halfArea(bvh.nodes[0].bounds);
    if (!(root > 0)) return weights;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const Node& node = bvh.nodes[i];
        if (i != 1 && !node.isLeaf()) weights[node.left() / 2] = halfArea(node.bounds) / root;
    }
    return weights;
}

PairWeights weightsByVisits(const Bvh& bvh, std::span<const uint32_t> visits, float smoothing) {
    PairWeights weights = weightsByArea(bvh);
    if (visits[0] == 0) return weights;
    const double lines = std::max(double(smoothing), 1e-6) * visits[0];
    for (size_t i = 0; i < weights.size(); ++i) weights[i] = visits[i] + lines * weights[i];
    return weights;
}

}  // namespace bvhio
