// bvh-restructure: lowers a tree's cost by changing its nodes.
#include "common/pass.h"
#include "common/run_tool.h"
#include "common/unused_options.h"
#include "compress/exact_boxes.h"
#include "core/report.h"
#include "restructure/restructurers.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-restructure",
    "Lowers the SAH cost of a container's tree by changing its nodes.",
    "  bvh-build scene.glb | bvh-restructure -o scene.bvhx\n"
    "  bvh-build scene.glb | bvh-restructure --iterations 100 --report steps.json -o "
    "scene.bvhx\n",
};

Report iterationsOf(const Restructured& result) {
    Report list = Report::array();
    for (const RestructureIteration& iteration : result.iterations)
        list.push_back({{"sah_cost", iteration.sahCost},
                        {"seconds", iteration.seconds},
                        {"changes", iteration.changes}});
    return list;
}

ExitCode restructure(CommandLine& line) {
    RestructureOptions options;
    std::string method(restructurers()[0].name);
    line.choice("--method", method, namedValues(restructurers()), "how the tree is changed");
    line.number("--iterations", options.iterations, 0, 100000,
                "passes over the tree; 0: the method's own number");
    line.number("--treelet-size", options.treeletSize, 0, kMaxTreeletSize,
                "leaves per treelet, for atr and tr; 0: the method's own number");
    line.number("--gamma", options.gamma, 0, 1u << 30,
                "fewest references below the root of a treelet, for atr and tr; 0: the treelet size");
    line.toggle("collapse", options.collapse,
                "split leaves into single triangles first, and form new leaves where that is cheaper");
    line.number("--max-leaf-size", options.maxLeafSize, 0, kMaxLeafSize,
                "most triangles in a new leaf; 0: the most in a leaf of INPUT, but at least 4");
    Pass pass(line, "INPUT", "container; - or nothing: standard input");
    const Restructurer& chosen = choose(restructurers(), "method", method);
    refuseUnused(line, "method", chosen,
                 {{"--iterations", kUsesIterations},
                  {"--treelet-size", kUsesTreelets},
                  {"--gamma", kUsesTreelets},
                  {"--collapse", kUsesLeaves},
                  {"--max-leaf-size", kUsesLeaves}});
    if (!options.collapse && line.isGiven("--max-leaf-size"))
        throw Error(ErrorKind::usage,
                    "--max-leaf-size: --no-collapse forms no new leaves: leave one of them out");

    BvhxFile file = pass.read();
    pass.stages().begin("restructure");
    options.costs = file.costs;
    options.recordCosts = pass.reports();
    options.progress = &pass.stages().progress();
    const bool isExact = traitsOf(file.bvh).isExact;
    Report iterations = Report::array();
    double seconds = 0, bytesPerNode = 0;
    changeTrees(file, [&](const Scene& scene, const Bvh& given, bool isTop) {
        // Costs are those of the tree's exact boxes, not of the larger ones of a compact form.
        const Bvh bvh = isExact ? given : withExactBoxes(scene, given);
        RestructureOptions own = options;
        if (isTop) own.collapse = false;  // an instance has a leaf of its own
        const double start = pass.stages().elapsed();
        Restructured result = chosen.function(scene, bvh, own);
        seconds += pass.stages().elapsed() - start - result.recordingSeconds;
        bytesPerNode = std::max(bytesPerNode, result.bytesPerNode);
        if (!file.scene.isInstanced()) iterations = iterationsOf(result);
        return std::move(result.bvh);
    });
    dropChunksThatDoNotSurvive(file, Change::topologyChanged);
    dropChunksThatDoNotSurvive(file, Change::reordered);
    pass.finish(file, {}, "restructure",
                {{"seconds", seconds}, {"iterations", iterations}, {"bytes_per_node", bytesPerNode}});
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, restructure);
}
