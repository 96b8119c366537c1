// The statistics of a canonical tree.
#pragma once

#include <string_view>
#include <vector>

#include "compress/forms.h"
#include "core/report_fwd.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

struct TreeStats {
    uint64_t references = 0;  // entries of Bvh::primitives; more than the triangles if splits duplicated some
    uint64_t nodes = 0, innerNodes = 0, leaves = 0;
    uint32_t maxDepth = 0;  // edges from the root
    double averageLeafDepth = 0;
    SahCosts costs{};
    double sahCost = 0;
    /// The numbers of entered nodes and of tested triangles that the SAH expects for a long random line
    /// through the root's box.
    double expectedInnerNodes = 0, expectedLeaves = 0, expectedTriangles = 0;
    /// The half area that the boxes of both children share, as a fraction of the half areas of inner boxes; 0
    /// if siblings at most touch.
    double childOverlap = 0;
    std::vector<uint64_t> leafDepths;  // [d]: leaves at depth d
    std::vector<uint64_t> leafSizes;   // [n]: leaves with n references
};

TreeStats treeStats(const Bvh& bvh, const SahCosts& costs);

/// Returns the statistics of an instanced scene's trees. Counts are sums over all trees, except that leaves
/// are only those of meshes. Depths count within each tree. For the SAH an instance is a leaf of the top tree
/// that costs as much as the mesh's tree in the mesh's own space. child_overlap is that of the top tree.
TreeStats treeStats(const Scene& scene, const InstancedBvh& bvh, const SahCosts& costs);

/// Returns the SAH cost of a tree as its form stores it, instanced or not.
double sahCost(const Scene& scene, const EncodedBvh& bvh, const SahCosts& costs);

/// Adds the keys references, nodes, inner_nodes, leaves, max_depth, average_leaf_depth, sah_cost,
/// traversal_cost, intersection_cost, expected{inner_nodes, leaves, triangles}, child_overlap,
/// leaf_depths{depth: leaves} and leaf_sizes{references: leaves}.
void addTo(Report& report, const TreeStats& stats);

/// Returns the layout, as far as the tree shows it. "clusters" means that the tree has a slot map. The others
/// are orders of sibling pairs in memory: "dfs" (each pair, its left subtree, its right subtree), "odfs" (the
/// subtree with the larger box first), "depth-first" (whole subtrees in another order, such as that of
/// visits), "bfs" (level by level), or "other". If several apply, as in a small tree, returns the first of
/// them. O(n).
std::string_view layoutName(const Bvh& bvh);

}  // namespace bvhio
