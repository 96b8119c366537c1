// bvh-build: from a scene to a container; or from a container's tree to the same tree over a moved scene.
#include "build/builders.h"
#include "build/instanced.h"
#include "build/spatial.h"
#include "common/input.h"
#include "common/log.h"
#include "common/pass.h"
#include "common/run_tool.h"
#include "common/useless_options.h"
#include "file/form_chunks.h"
#include "importers/import.h"
#include "scene/moved_scene.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-build",
    "Builds a BVH over the triangles of a scene: glTF, GLB, OBJ, PLY, STL or Draco.",
    "  bvh-build scene.glb -o scene.bvhx\n"
    "  bvh-build scene.ply --builder median | bvh-stats\n"
    "  bvh-build scene.glb --two-level -o instanced.bvhx\n"
    "  bvh-build moved.glb --refit scene.bvhx -o moved.bvhx\n",
};

const std::vector<NamedValue> kOnDegenerate = {
    {"keep", "they can't be hit, but keep their ids"},
    {"drop", "leave them out; the others keep their ids"},
    {"error", "refuse the scene"},
};

OnDegenerate onDegenerate(std::string_view name) {
    return name == "drop" ? OnDegenerate::drop : name == "error" ? OnDegenerate::error : OnDegenerate::keep;
}

Error withName(const std::string& input, const Error& error) {
    return {error.kind(), (input == "-" ? "standard input" : input) + ": " + error.what()};
}

Scene import(const std::string& input, const ImportOptions& options, bool shares = false) {
    const std::string name = input == "-" ? "standard input" : input;
    ImportedScene imported = input == "-" ? importBytes(readWholeFile(input), name, ".") : importFile(input);
    try {
        return shares ? shareMeshes(std::move(imported), options) : flatten(std::move(imported), options);
    } catch (const Error& error) {
        throw withName(input, error);  // meshes don't know their file
    }
}

/// The tree of the container `old`, in its form, fitted to the scene, which must be the same mesh.
void refit(Pass& pass, const std::string& old) {
    BvhxFile file = pass.read(old);
    if (isInstanced(file.bvh))
        throw Error(ErrorKind::usage, "--refit: " + old + " has instances: build anew with --two-level");
    pass.stages().begin("import");
    const Scene scene = import(pass.input(), {});
    pass.stages().begin("refit");
    try {
        file.scene = movedScene(file.scene, scene);
    } catch (const Error& error) {
        throw withName(pass.input(), error);
    }
    const size_t references = std::visit([](const auto& form) { return form.primitives().size(); }, file.bvh);
    if (references > file.scene.triangles.size())
        logInfo(
            "boxes of triangles that spatial splits cut grow to whole triangles: build anew for tight ones");
    file.bvh = refitTo(file.bvh, file.scene);
    dropChunksThatDoNotSurvive(file, Change::topologyChanged);
    dropChunksThatDoNotSurvive(file, Change::reordered);
    pass.recordOptions({{"refit", true}});
    pass.finish(file, {}, "refit",
                {{"form", formNameOf(file.bvh)},
                 {"primitives", file.scene.triangles.size()},
                 {"references", references}});
}

EncodedBvh built(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    return AabbForm(builder.function(scene, options));
}

/// A tree for each mesh, and one over their instances.
EncodedBvh builtInstanced(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    return TwoLevelForm::encodeInstances(scene, buildInstanced(scene, builder, options), exactLevels());
}

ExitCode build(CommandLine& line) {
    BuildOptions options;
    std::string builder(builders()[0].name), degenerate(kOnDegenerate[0].name);
    line.choice("--builder", builder, namedValues(builders()), "how the tree is built");
    line.number("--bins", options.bins, 0, 256, "bins an axis, for binned and spatial; 0: the builder's own");
    line.number("--max-leaf-size", options.maxLeafSize, 1, kMaxLeafSize, "most triangles in a leaf");
    line.number("--split-budget", options.splitBudget, 0, kMaxSplitBudget,
                "for spatial: most references that cutting adds, per triangle");
    line.number("--traversal-cost", options.costs.traversal, 0, 1e6f, "SAH cost of visiting an inner node");
    line.number("--intersection-cost", options.costs.intersection, 0, 1e6f,
                "SAH cost of a ray-triangle test");
    line.choice("--on-degenerate", degenerate, kOnDegenerate, "what to do with triangles of zero area");
    bool twoLevel = false;
    line.flag("--two-level", twoLevel,
              "a tree for each mesh, in its own space, and one over their instances");
    line.beginPlumbing();
    std::string old;
    line.text("--refit", "OLD.bvhx", old, "build nothing: fit this file's tree to SCENE, its mesh moved");
    Pass pass(line, "SCENE", "the scene's file; - or nothing: standard input");
    if (!old.empty()) {
        if (!line.given().empty())
            throw Error(
                ErrorKind::usage,
                line.given()[0] + ": --refit keeps the tree that OLD.bvhx has: leave one of them out");
        if (old == "-" && pass.input() == "-")
            throw Error(ErrorKind::usage, "--refit: standard input is SCENE already: name a file");
        refuseTerminalInput(old);
        refit(pass, old);
        return ExitCode::done;
    }

    const Builder& chosen = choose(builders(), "builder", builder);
    refuseUseless(line, "builder", chosen, {{"--bins", kUsesBins}, {"--split-budget", kUsesSplitBudget}});
    pass.stages().begin("import");
    Scene scene = import(pass.input(), {onDegenerate(degenerate)}, twoLevel);
    pass.stages().begin("build");
    options.progress = &pass.stages().progress();
    EncodedBvh bvh = twoLevel ? builtInstanced(scene, chosen, options) : built(scene, chosen, options);
    BvhxFile file{std::move(scene), std::move(bvh), options.costs, {}, {}};
    Report counts = {{"primitives", file.scene.triangles.size()}};
    if (twoLevel)
        counts.update({{"meshes", file.scene.meshes.size()},
                       {"instances", file.scene.instances.size()},
                       {"instanced_primitives", file.scene.primitiveCount()}});
    pass.finish(file, {}, "build", counts);
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, build);
}
