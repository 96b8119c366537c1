// bvh-restructure: lowers a tree's cost by changing which nodes it has.
#include "common/pass.h"
#include "common/run_tool.h"
#include "restructure/restructurers.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-restructure",
    "Lowers the cost of a container's tree by changing which nodes it has.",
    "  bvh-build scene.glb | bvh-restructure -o scene.bvhx\n",
};

ExitCode restructure(CommandLine& line) {
    std::string method(restructurers()[0].name);
    line.choice("--method", method, namedValues(restructurers()), "how the tree is changed");
    Pass pass(line, "INPUT", "the container; - or nothing: standard input");

    BvhxFile file = pass.read();
    pass.stages().begin("restructure");
    const auto& chosen = choose(restructurers(), "method", method);
    file.bvh = AabbForm(chosen.function(decode(file.bvh), {file.costs}));
    dropChunksThatDoNotSurvive(file, Change::topologyChanged);
    dropChunksThatDoNotSurvive(file, Change::reordered);
    pass.finish(file, {}, "restructure");
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, restructure);
}
