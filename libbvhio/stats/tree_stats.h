// What a canonical tree looks like, in numbers.
#pragma once

#include <string_view>
#include <vector>

#include "compress/forms.h"
#include "core/report.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

struct TreeStats {
    uint64_t references =
        0;  // entries of Bvh::primitives; more than the scene's triangles when splits duplicated some
    uint64_t nodes = 0, innerNodes = 0, leaves = 0;
    uint32_t maxDepth = 0;  // edges from the root
    double averageLeafDepth = 0;
    SahCosts costs{};
    double sahCost = 0;
    /// What the SAH expects of a long random line through the root's box: nodes entered, and triangles
    /// tested.
    double expectedInnerNodes = 0, expectedLeaves = 0, expectedTriangles = 0;
    /// Of the half areas of inner boxes, the part that both children's boxes share: 0 when siblings at most
    /// touch.
    double childOverlap = 0;
    std::vector<uint64_t> leafDepths;  // [d] = leaves at depth d
    std::vector<uint64_t> leafSizes;   // [n] = leaves of n references
};

TreeStats treeStats(const Bvh& bvh, const SahCosts& costs);

/// Of an instanced scene's trees. Counts are sums over all of them, but leaves those of meshes; depths count
/// within each tree. To the SAH an instance is a leaf of the top that costs what the mesh's tree does in the
/// mesh's own space, and child_overlap is that of the top.
TreeStats treeStats(const Scene& scene, const InstancedBvh& bvh, const SahCosts& costs);

/// The cost of a tree as its form stores it, instanced or not.
double sahCost(const Scene& scene, const EncodedBvh& bvh, const SahCosts& costs);

/// Adds the keys references, nodes, inner_nodes, leaves, max_depth, average_leaf_depth, sah_cost,
/// traversal_cost, intersection_cost, expected{inner_nodes, leaves, triangles}, child_overlap,
/// leaf_depths{depth: leaves} and leaf_sizes{references: leaves}.
void addTo(Report& report, const TreeStats& stats);

/// The layout as far as it shows in the tree: "clusters" (it has a slot map); or by the order of sibling
/// pairs in memory "dfs" (each pair, its left subtree, its right one), "odfs" (of two subtrees the one with
/// the larger box first), "depth-first" (whole subtrees too, in another order, such as that of visits), "bfs"
/// (level by level), or "other". Where several are true, as in a small tree, it is the first of those. O(n).
std::string_view layoutName(const Bvh& bvh);

}  // namespace bvhio
