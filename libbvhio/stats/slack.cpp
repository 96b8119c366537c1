#include "stats/slack.h"

#include "compress/exact_boxes.h"
#include "core/report.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

Report slackReport(const Slack& slack) {
    return {{"nodes", slack.nodes},
            {"total", slack.total()},
            {"mean", slack.mean()},
            {"max", slack.max},
            {"unbounded", slack.unbounded}};
}

}  // namespace

void Slack::add(double halfArea, double exactHalfArea) {
    ++nodes;
    area += halfArea;
    exactArea += exactHalfArea;
    if (exactHalfArea == 0 && halfArea > 0) {
        ++unbounded;
        return;
    }
    const double ratio = halfArea == exactHalfArea ? 1 : halfArea / exactHalfArea;
    sumOfRatios += ratio;
    if (ratio > max) max = ratio;
}

SlackStats slackStats(const Scene& scene, const Bvh& bvh, const SahCosts& costs) {
    const Bvh exact = withExactBoxes(scene, bvh);
    SlackStats stats;
    stats.sahCost = sahCost(bvh, costs);
    stats.exactSahCost = sahCost(exact, costs);
    const std::vector<uint32_t> depths = depthsOfPairs(bvh);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1) continue;  // the unused slot beside the root
        const uint32_t depth = depths[i / 2];
        if (depth >= stats.levels.size()) stats.levels.resize(depth + 1);
        const double area = halfArea(bvh.nodes[i].bounds), exactArea = halfArea(exact.nodes[i].bounds);
        stats.levels[depth].add(area, exactArea);
        stats.all.add(area, exactArea);
    }
    return stats;
}

void addTo(Report& report, const SlackStats& stats) {
    report["exact_sah_cost"] = stats.exactSahCost;
    report["sah_ratio"] = stats.sahCost == stats.exactSahCost ? 1 : stats.sahCost / stats.exactSahCost;
    report["slack"] = slackReport(stats.all);
    report["slack"].erase("nodes");
    Report& levels = report["slack"]["levels"] = Report::array();
    for (size_t depth = 0; depth < stats.levels.size(); ++depth) {
        levels.push_back({{"depth", depth}});
        levels.back().update(slackReport(stats.levels[depth]));
    }
}

}  // namespace bvhio
