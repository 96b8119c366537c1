// Random treelets, and the costs of plans over them, for tests of treelet planners.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/random.h"
#include "restructure/treelets.h"

namespace bvhio::test {

inline constexpr float kNoLimit = std::numeric_limits<float>::infinity();

/// A subtree over some of a treelet's leaves.
struct Subtree {
    float sides[6];
    float cost, references;

    float area() const {
        const float x = sides[0] + sides[3], y = sides[1] + sides[4], z = sides[2] + sides[5];
        return x * (y + z) + y * z;
    }
};

inline Subtree leafOf(const Treelet& treelet, uint32_t i) {
    Subtree leaf{{}, treelet.costs[i], treelet.references[i]};
    for (int side = 0; side < 6; ++side) leaf.sides[side] = treelet.boxes[side][i];
    return leaf;
}

inline Subtree join(const Subtree& a, const Subtree& b, const TreeletCosts& costs) {
    Subtree node = a;
    for (int side = 0; side < 6; ++side) node.sides[side] = std::max(a.sides[side], b.sides[side]);
    node.references = a.references + b.references;
    node.cost = costs.of(node.area(), node.references, a.cost, b.cost);
    return node;
}

/// Returns the cost of a plan, which must use every leaf and the node of every step once.
inline float costOf(const Treelet& treelet, const TreeletCosts& costs, const TreeletPlan& plan) {
    std::vector<Subtree> nodes;
    for (uint32_t i = 0; i < treelet.size; ++i) nodes.push_back(leafOf(treelet, i));
    std::vector<int> uses(2 * treelet.size - 1, 0);
    for (uint32_t step = 0; step + 1 < treelet.size; ++step) {
        for (const uint32_t child : {plan.left[step], plan.right[step]}) {
            if (child >= nodes.size()) {
                ADD_FAILURE() << "step " << step << " joins node " << child;
                return 0;
            }
            EXPECT_EQ(++uses[child], 1) << "node " << child;
        }
        nodes.push_back(join(nodes[plan.left[step]], nodes[plan.right[step]], costs));
    }
    return nodes.back().cost;
}

/// Returns a treelet whose leaves have few references, near each other or not. On a grid many distances and
/// costs are equal.
inline Treelet randomTreelet(uint32_t size, uint64_t seed, bool onGrid) {
    Random random(seed);
    Treelet treelet;
    treelet.size = size;
    for (uint32_t i = 0; i < size; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float low = onGrid ? float(random.below(3)) : random.uniform(-2, 2);
            const float extent = onGrid ? float(random.below(2)) : random.uniform(0, 1);
            treelet.boxes[axis][i] = -low;
            treelet.boxes[axis + 3][i] = low + extent;
        }
        treelet.references[i] = float(1 + random.below(3));
        const float area = leafOf(treelet, i).area();
        treelet.costs[i] = area * treelet.references[i] * (onGrid ? 1.0f : random.uniform(0.5f, 1));
    }
    return treelet;
}

}  // namespace bvhio::test
