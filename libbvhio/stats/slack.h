// Slack: how much larger the boxes that a form reconstructs are than the exact boxes of the same tree.
#pragma once

#include <vector>

#include "core/report_fwd.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// Compares the boxes of nodes with their exact boxes, by area. A node whose exact box has no area is tight
/// if its reconstructed box has no area either. Otherwise it counts as `unbounded`, and is left out of mean
/// and max.
struct Slack {
    uint64_t nodes = 0, unbounded = 0;
    double area = 0, exactArea = 0;  // sums of half areas
    double sumOfRatios = 0, max = 1;

    /// Returns the slack as the SAH sees it: the sum of areas, divided by the sum of exact areas. Infinite if
    /// that is 0.
    double total() const { return area == exactArea ? 1 : area / exactArea; }
    /// Returns the mean over nodes of the ratio of each node's areas.
    double mean() const { return nodes == unbounded ? 1 : sumOfRatios / double(nodes - unbounded); }
    void add(double halfArea, double exactHalfArea);
};

/// Compares a tree with the same tree with exact boxes (compress/exact_boxes.h). The exact box of a node is
/// the smallest that contains the triangles below it; of triangles that spatial splits cut, only the part
/// inside the leaf's box counts. So for trees with split triangles slack is a lower bound, unless the boxes
/// are those of the builder, which are exact.
struct SlackStats {
    double sahCost = 0, exactSahCost = 0;  // of the given tree, and with exact boxes
    Slack all;
    std::vector<Slack> levels;  // [d]: of the nodes at depth d
};

/// Computes the slack of a tree, whose boxes must contain its triangles. Parallel.
SlackStats slackStats(const Scene& scene, const Bvh& bvh, const SahCosts& costs);

/// Adds the keys exact_sah_cost, sah_ratio (the tree's cost over it) and slack{total, mean, max,
/// unbounded, levels[]{depth, nodes, total, mean, max, unbounded}}.
void addTo(Report& report, const SlackStats& stats);

}  // namespace bvhio
