// The common part of the treelet restructurers: the roots of treelets and their order, how treelets form, and
// how a better tree replaces a treelet. A method only provides the tree that it finds over a treelet's
// leaves.
//
// A treelet (Karras and Aila 2013) is a node and a connected set of nodes below it. At first it is the node
// and its children. Then, again and again, the leaf of largest area is replaced by its children, until there
// are enough leaves. The leaves may be inner nodes of the whole tree.
#pragma once

#include <cstdint>

#include "restructure/restructurers.h"

namespace bvhio {

/// The costs of trees over the leaves of treelets.
struct TreeletCosts {
    float traversal, intersection;
    float maxLeafSize;  // the most references of a leaf that forms; 0: no leaves form

    /// Returns the cost of a node over two subtrees: of an inner node, or of a leaf if one may form and costs
    /// less.
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
    /// The negated minima of x, y and z, then the maxima, in any unit; areas are in its square.
    alignas(64) float boxes[6][kLanes] = {};
    alignas(64) float costs[kLanes] = {};       // of the subtree below
    alignas(64) float references[kLanes] = {};  // in the subtree below
};

/// A tree over the leaves of a treelet. Step i joins two nodes. Numbers below `size` are leaves, and `size` +
/// k is the node that step k made. The last step makes the root.
struct TreeletPlan {
    uint8_t left[kMaxTreeletSize - 1], right[kMaxTreeletSize - 1];
};

/// Plans a tree over a treelet of at least 3 leaves. Returns false, and an undefined plan, if the method's
/// tree does not cost less than `limit`.
using TreeletPlanner = bool (*)(const Treelet& treelet, const TreeletCosts& costs, float limit,
                                TreeletPlan& plan);

struct TreeletMethod {
    uint32_t size, largestSize;  // leaves of a treelet: the default, and the most
    uint32_t iterations;         // the default number of iterations
    uint32_t topPasses;          // the most passes of an iteration over the few nodes with many references
    TreeletPlanner planner;
};

/// Restructures a tree by treelets. In each iteration all nodes with enough references below them, children
/// before parents, are roots of treelets, which are rebuilt if that lowers the cost. The least number of
/// references doubles with each iteration; iterations for which no node has enough are left out.
Restructured restructureTreelets(const Scene& scene, const Bvh& bvh, const RestructureOptions& options,
                                 const TreeletMethod& method);

}  // namespace bvhio
