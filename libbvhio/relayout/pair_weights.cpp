#include "relayout/pair_weights.h"

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

}  // namespace bvhio
