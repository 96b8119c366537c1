#include "tree/sah_cost.h"

namespace bvhio {

double sahCost(const Bvh& bvh, const SahCosts& costs) {
    const double rootArea = halfArea(bvh.nodes[0].bounds);
    double cost = 0;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1) continue;  // the unused slot beside the root
        const Node& node = bvh.nodes[i];
        const double probability = rootArea > 0 ? halfArea(node.bounds) / rootArea : 1.0;
        cost += probability *
                (node.isLeaf() ? double(costs.intersection) * node.primitiveCount : costs.traversal);
    }
    return cost;
}

}  // namespace bvhio
