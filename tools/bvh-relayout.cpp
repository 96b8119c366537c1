// bvh-relayout: orders a tree's nodes in memory; its cost stays.
#include "common/pass.h"
#include "common/run_tool.h"
#include "relayout/layouts.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-relayout",
    "Orders the nodes of a container's tree, and its leaves' primitives, in memory.",
    "  bvh-relayout scene.bvhx --layout dfs -o scene.bvhx\n",
};

ExitCode relayout(CommandLine& line) {
    std::string layout(layouts()[0].name);
    line.choice("--layout", layout, namedValues(layouts()), "the order of the nodes");
    Pass pass(line, "INPUT", "the container; - or nothing: standard input");

    BvhxFile file = pass.read();
    pass.stages().begin("relayout");
    const auto order = choose(layouts(), "layout", layout).function;
    changeTrees(file, [&](const Scene&, const Bvh& bvh, bool) { return applyNodeOrder(bvh, order(bvh)); });
    dropChunksThatDoNotSurvive(file, Change::reordered);
    pass.finish(file, {}, "relayout");
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, relayout);
}
