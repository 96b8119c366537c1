// bvh-compress: chooses how a container's tree is stored, and compresses its chunks.
#include "common/form_options.h"
#include "common/form_search.h"
#include "common/log.h"
#include "common/pass.h"
#include "common/run_tool.h"
#include "container/codecs.h"
#include "core/report.h"
#include "file/change_form.h"
#include "scene/scene_order.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-compress",
    "Stores a container's tree in another form, and compresses its chunks.",
    "  bvh-compress scene.bvhx --codec zstd -o small.bvhx\n"
    "  bvh-compress scene.bvhx --codec topology -o smaller.bvhx\n"
    "  bvh-compress scene.bvhx --form quantized-short -o small.bvhx\n"
    "  bvh-compress scene.bvhx --form two-level --blas-form ssh --blas-size 32 -o two-level.bvhx\n"
    "  bvh-compress scene.bvhx --max-slowdown 1.2 --pareto forms.csv -o compact.bvhx\n"
    "  bvh-compress scene.bvhx --geometry draco --position-bits 14 -o rounded.bvhx\n",
};

const std::vector<NamedValue> kGeometries = {
    {"raw", "vertices and indices, unchanged"},
    {"draco", "vertices rounded to a grid, boxes fitted to them; triangles keep their ids"},
};

/// What the command line asks for, but for the options of forms.
struct Choices {
    std::string form;  // empty: as suits the file
    std::string codec = "zstd", geometry = "raw", triangleOrder = "source", vertexOrder = "auto";
    uint32_t level = 0, positionBits = 16;

    /// --codec topology is zstd, and nodes without boxes.
    bool isTopology() const { return codec == "topology"; }
};

/// Logs what the form will do to the tree though nobody asked for it.
void announce(const BvhxFile& file, const std::string& form) {
    const FormTraits& traits = traitsOf(form);
    if (traits.putsInClusters && decode(file.bvh).slots.empty())
        logInfo("the tree is put in clusters as bvh-relayout --layout clusters does");
    if (traits.buildsOwnTree) logInfo(form + " builds a tree of its own from the triangles");
}

/// The codecs of chunks, and one that squeezes the nodes of the aabb form as well.
std::vector<NamedValue> codecNames() {
    std::vector<NamedValue> names = namedValues(codecs());
    names.push_back(
        {"topology", "zstd, and nodes without boxes, which are fitted again when read (form aabb)"});
    return names;
}

const std::vector<NamedValue> kTriangleOrders = {
    {"source", "unchanged"},
    {"leaf", "leaf order within each geometry; ids are kept"},
};
const std::vector<NamedValue> kVertexOrders = {
    {"auto", "unchanged; for draco, whichever order is smaller"},
    {"source", "unchanged"},
    {"use", "order of first use by triangles"},
};

void declareStorage(CommandLine& line, Choices& choices) {
    line.choice("--codec", choices.codec, codecNames(), "compression of the chunks");
    line.number("--level", choices.level, 0, 19,
                "compression level of zstd, 1 (fast) to 19 (small); 0: its default");
    line.choice("--geometry", choices.geometry, kGeometries, "how the triangles are stored");
    line.number("--position-bits", choices.positionBits, 1, 30, "bits per coordinate (draco)");
    line.choice("--triangle-order", choices.triangleOrder, kTriangleOrders, "order of the triangles");
    line.choice("--vertex-order", choices.vertexOrder, kVertexOrders, "order of the vertices");
}

/// Boxes can be left out of a file where they can be fitted again.
void settleTopology(Choices& choices, const FormSearch& search) {
    if (!choices.isTopology()) return;
    if (choices.form.empty()) choices.form = forms()[0].name;
    if (!traitsOf(choices.form).isExact || search.choosesForm())
        throw Error(ErrorKind::usage,
                    "--codec topology: only --form aabb has boxes that fit again: use --codec zstd");
}

/// Measures the forms, and puts the one that suits best on the command line. False, with a line on standard
/// error, when a limit asks for one and none keeps it.
bool searchForm(FormSearch& search, CommandLine& line, const std::string& form, const BvhxFile& file,
                Progress& progress) {
    const bool onlyForm = search.choosesForm() && line.isGiven("--form");
    const TunedEncoding* chosen = search.search(file.scene, exactTree(file), onlyForm ? form : "", progress);
    if (search.choosesForm() && chosen == nullptr) {
        logError(search.refusal());
        return false;
    }
    if (chosen != nullptr) search.assignTo(line);
    return true;
}

/// Refuses what an instanced scene cannot have.
void checkInstances(const CommandLine& line, const std::string& form) {
    if (!traitsOf(form).holdsInstances)
        throw Error(ErrorKind::usage, "--form " + form +
                                          ": the scene has instances: use two-level, or build without "
                                          "--two-level");
    if (line.isGiven("--blas-size"))
        throw Error(ErrorKind::usage,
                    "--blas-size: the scene has instances, whose meshes are BLASes whole: leave it out");
}

WriteOptions writeOptionsFor(const Choices& choices) {
    WriteOptions options;
    options.codec = choices.isTopology() ? "zstd" : choices.codec;
    options.nodes = choices.isTopology() ? NodeEncoding::topology : NodeEncoding::plain;
    options.codecLevel = int(choices.level);
    options.geometry = choices.geometry == "draco" ? GeometryEncoding::draco : GeometryEncoding::raw;
    options.dracoPositionBits = int(choices.positionBits);
    options.dracoVertices = choices.vertexOrder == "auto" ? VertexOrder::smaller : VertexOrder::kept;
    return options;
}

ExitCode compress(CommandLine& line) {
    Choices choices;
    std::string& form = choices.form;
    line.choice("--form", form, namedValues(forms()), "how nodes are stored");
    FormOptions formOptions(line);
    line.dropped("--record-bytes", "--form quantized-short for records of 8 bytes, --form quantized for 16");
    FormSearch search(line);
    declareStorage(line, choices);
    line.beginPlumbing();
    Pass pass(line, "INPUT", "the container; - or nothing: standard input");

    // What can be refused is refused before the file is read.
    search.prepare(
        line, {"--codec", "--level", "--geometry", "--position-bits", "--triangle-order", "--vertex-order"});
    settleTopology(choices, search);
    if (!form.empty()) formOptions.check(form);

    BvhxFile file = pass.read();
    Report extra = Report::object();
    if (search.isWanted()) {
        pass.stages().begin("search");
        if (!searchForm(search, line, form, file, pass.stages().progress())) return ExitCode::findings;
        extra["search"] = search.report();
    }
    const EncodeOptions defaults = settleForm(form, file);
    formOptions.check(form);
    const EncodeOptions options = formOptions.fill(form, defaults);
    pass.recordOptions(search.recordedOptions(line));

    pass.stages().begin("compress");
    if (file.scene.isInstanced())
        checkInstances(line, form);
    else if (!isStoredAs(file.bvh, form, options))
        announce(file, form);
    changeForm(file, form, options);
    if (choices.triangleOrder == "leaf") orderTrianglesByLeaves(file);
    if (choices.vertexOrder == "use") file.scene = withVerticesByUse(file.scene);
    pass.finish(file, writeOptionsFor(choices), "compress", extra);
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, compress);
}
