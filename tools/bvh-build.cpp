// bvh-build: makes a container from a scene, or fits the tree of a container to the scene in another pose.
#include "build/builders.h"
#include "build/instanced.h"
#include "build/spatial.h"
#include "common/import_summary.h"
#include "common/input.h"
#include "common/log.h"
#include "common/pass.h"
#include "common/run_tool.h"
#include "common/unused_options.h"
#include "core/report.h"
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
    {"keep", "keep them with their ids; no ray can hit them"},
    {"drop", "leave them out; other triangles keep their ids"},
    {"error", "refuse the scene"},
};

OnDegenerate onDegenerate(std::string_view name) {
    return name == "drop" ? OnDegenerate::drop : name == "error" ? OnDegenerate::error : OnDegenerate::keep;
}

Error withName(const std::string& input, const Error& error) {
    return {error.kind(), inputName(input) + ": " + error.what()};
}

/// A scene, flattened or instanced, and what its file has.
struct SceneAndCounts {
    Scene scene;
    ImportCounts counts;
};

/// Reads the scene that `pass` names. Reading standard input is a stage of its own, as it waits for others.
SceneAndCounts importScene(Pass& pass, const ImportOptions& options, bool shares = false) {
    const std::string& input = pass.input();
    ImportedScene imported;
    if (input == "-") {
        pass.stages().begin("read", readingKind(input));
        const std::vector<std::byte> bytes = readWholeFile(input);
        pass.stages().begin("import");
        imported = importBytes(bytes, inputName(input), ".");
    } else {
        pass.stages().begin("import");
        imported = importFile(input);
    }
    const ImportCounts counts = countsOf(imported);
    try {
        Scene scene =
            shares ? shareMeshes(std::move(imported), options) : flatten(std::move(imported), options);
        logImport(counts, !shares);
        return {std::move(scene), counts};
    } catch (const Error& error) {
        throw withName(input, error);  // meshes don't know their file
    }
}

/// Fits the tree of the container `old`, in its form, to the scene, which must be the same mesh.
void refit(Pass& pass, const std::string& old) {
    BvhxFile file = pass.read(old);
    if (isInstanced(file.bvh))
        throw Error(ErrorKind::usage, "--refit: " + old + " has instances: build again with --two-level");
    const SceneAndCounts moved = importScene(pass, {});
    pass.stages().begin("refit");
    try {
        file.scene = movedScene(file.scene, moved.scene);
    } catch (const Error& error) {
        throw withName(pass.input(), error);
    }
    const size_t references = std::visit([](const auto& form) { return form.primitives().size(); }, file.bvh);
    if (references > file.scene.triangles.size())
        logInfo(
            "boxes of triangles that spatial splits cut grow to whole triangles: build again for tight "
            "boxes");
    file.bvh = refitTo(file.bvh, file.scene);
    dropChunksThatDoNotSurvive(file, Change::topologyChanged);
    dropChunksThatDoNotSurvive(file, Change::reordered);
    pass.recordOptions({{"refit", true}});
    Report report = {{"form", formNameOf(file.bvh)},
                     {"primitives", file.scene.triangles.size()},
                     {"references", references}};
    report.update(reportOf(moved.counts));
    pass.finish(file, {}, "refit", report);
}

EncodedBvh built(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    return AabbForm(builder.function(scene, options));
}

/// A tree for each mesh, and one over their instances.
EncodedBvh builtInstanced(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    return TwoLevelForm::encodeInstances(scene, buildInstanced(scene, builder, options),
                                         TwoLevelForm::exactLevels());
}

ExitCode build(CommandLine& line) {
    BuildOptions options;
    std::string builder(builders()[0].name), degenerate(kOnDegenerate[0].name);
    line.choice("--builder", builder, namedValues(builders()), "how the tree is built");
    line.number("--bins", options.bins, 0, 256,
                "bins per axis, for binned and spatial; 0: chosen by the builder");
    line.number("--max-leaf-size", options.maxLeafSize, 1, kMaxLeafSize, "most triangles in a leaf");
    line.number("--split-budget", options.splitBudget, 0, kMaxSplitBudget,
                "most references per triangle that splitting adds, for spatial");
    line.number("--traversal-cost", options.costs.traversal, 0, 1e6f, "SAH cost of visiting an inner node");
    line.number("--intersection-cost", options.costs.intersection, 0, 1e6f,
                "SAH cost of a ray-triangle test");
    line.choice("--on-degenerate", degenerate, kOnDegenerate, "treatment of triangles of zero area");
    bool twoLevel = false;
    line.flag("--two-level", twoLevel,
              "keep instances: a tree for each mesh, in its own space, and one over their instances");
    std::string old;
    line.path("--refit", "OLD.bvhx", old,
              "container whose tree is fitted to SCENE, the same mesh in another pose, instead of building");
    Pass pass(line, "SCENE", "scene file; - or nothing: standard input");
    if (!old.empty()) {
        if (!line.given().empty())
            throw Error(ErrorKind::usage,
                        line.given()[0] + ": --refit keeps the tree of OLD.bvhx: leave one of them out");
        if (old == "-" && pass.input() == "-")
            throw Error(ErrorKind::usage, "--refit: standard input is already SCENE: name a file");
        refuseTerminalInput(old);
        refit(pass, old);
        return ExitCode::done;
    }

    const Builder& chosen = choose(builders(), "builder", builder);
    refuseUnused(line, "builder", chosen, {{"--bins", kUsesBins}, {"--split-budget", kUsesSplitBudget}});
    auto [scene, importCounts] = importScene(pass, {onDegenerate(degenerate)}, twoLevel);
    pass.stages().begin("build");
    options.progress = &pass.stages().progress();
    EncodedBvh bvh = twoLevel ? builtInstanced(scene, chosen, options) : built(scene, chosen, options);
    BvhxFile file{std::move(scene), std::move(bvh), options.costs, {}, {}};
    Report counts = {{"primitives", file.scene.triangles.size()}};
    if (twoLevel)
        counts.update({{"meshes", file.scene.meshes.size()},
                       {"instances", file.scene.instances.size()},
                       {"instanced_primitives", file.scene.primitiveCount()}});
    counts.update(reportOf(importCounts));
    pass.finish(file, {}, "build", counts);
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, build);
}
