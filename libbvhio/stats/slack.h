// How much larger the boxes are that a form reconstructs than the exact ones of the same tree.
#pragma once

#include <vector>

#include "core/report.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The boxes of some nodes against their exact ones, by area. Nodes whose exact box has no area are compared
/// only where the reconstructed one has none either (they are tight); else they count as `unbounded` and are
/// left out of mean and max.
struct Slack {
    uint64_t nodes = 0, unbounded = 0;
    double area = 0, exactArea = 0;  // sums of half areas
    double sumOfRatios = 0, max = 1;

    /// What the SAH sees of it: the areas' sum over that of the exact boxes. Infinite where those have none.
    double total() const { return area == exactArea ? 1 : area / exactArea; }
    /// Over nodes, of each one's own ratio.
    double mean() const { return nodes == unbounded ? 1 : sumOfRatios / double(nodes - unbounded); }
    void add(double halfArea, double exactHalfArea);
};

/// A tree beside the same with exact boxes (compress/exact_boxes.h): the smallest that hold the triangles
/// below each node, or, of triangles that spatial splits cut, what of them lies within the leaf's box. So for
/// trees with split triangles slack is a lower bound, unless the boxes are as the builder made them: those
/// are exact.
struct SlackStats {
    double sahCost = 0, exactSahCost = 0;  // of the tree as it is, and with exact boxes
    Slack all;
    std::vector<Slack> levels;  // [d] = of the nodes at depth d
};

/// The tree's boxes are to hold its triangles. Parallel.
SlackStats slackStats(const Scene& scene, const Bvh& bvh, const SahCosts& costs);

/// Adds the keys exact_sah_cost, sah_ratio (the tree's cost over it) and slack{total, mean, max,
/// unbounded, levels[]{depth, nodes, total, mean, max, unbounded}}.
void addTo(Report& report, const SlackStats& stats);

}  // namespace bvhio
