// What the treelet restructurers share: which nodes root treelets and in what order, how treelets form, and
// how a better tree over one takes effect. A method brings only the tree that it finds over a treelet's
// leaves.
//
// A treelet (Karras and Aila 2013) is a node and some of those below it that belong together: at first the
// node and its children, then, again and again, the leaf of largest area is replaced by its children, until
// there are leaves enough. They may be inner nodes of the whole tree.
#pragma once

#include <cstdint>

#include "restructure/restructurers.h"

namespace bvhio {

/// What trees over treelets' leaves cost.
struct TreeletCosts {
    float traversal, intersection;
    float maxLeafSize;  // most references of a leaf that forms; 0: none does

    /// Of a node over two subtrees: an inner node, or a leaf if one may form and costs less.
    float of(float area, float references, float left, float right) const {
        const float inner = traversal * area + (left + right);
        const float leaf = references <= maxLeafSize ? intersection * area * references : inner;
        return leaf < inner ? leaf : inner;
    }
};

/// The leaves of a treelet, component by component.
struct Treelet {
    static constexpr uint32_t kLanes = 32;
    static_assert(kLanes >= kMaxTreeletSize);

    uint32_t size = 0;
    /// Minima of x, y and z, negated, then maxima; of any unit: areas are in its square.
    alignas(64) float boxes[6][kLanes] = {};
    alignas(64) float costs[kLanes] = {};       // of the subtree below
    alignas(64) float references[kLanes] = {};  // in the subtree below
};

/// A tree over the leaves of a treelet: step i joins two nodes, of which those before `size` are leaves and
/// `size` + k is what step k made. The last step makes the root.
struct TreeletPlan {
    uint8_t left[kMaxTreeletSize - 1], right[kMaxTreeletSize - 1];
};

/// Plans a tree over a treelet of at least 3 leaves. False if the method's tree costs no less than `limit`;
/// the plan means nothing then.
using TreeletPlanner = bool (*)(const Treelet& treelet, const TreeletCosts& costs, float limit,
                                TreeletPlan& plan);

struct TreeletMethod {
    uint32_t size, largestSize;  // leaves of a treelet: by default, and at most
    uint32_t iterations;         // by default
    uint32_t topPasses;          // most passes in an iteration over the few nodes with many references
    TreeletPlanner planner;
};

/// In each iteration all nodes with enough references below them, children before parents, root a treelet,
/// which is rebuilt where that lowers the cost. Iterations that are too late to find such nodes are left out.
Restructured restructureTreelets(const Scene& scene, const Bvh& bvh, const RestructureOptions& options,
                                 const TreeletMethod& method);

}  // namespace bvhio
