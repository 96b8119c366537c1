// bvh-compress: chooses how a container's tree is stored, and squeezes its chunks.
#include "common/form_options.h"
#include "common/form_search.h"
#include "common/log.h"
#include "common/pass.h"
#include "common/run_tool.h"
#include "compress/exact_boxes.h"
#include "container/codecs.h"
#include "scene/scene_order.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-compress",
    "Stores a container's tree in another form, and squeezes its chunks.",
    "  bvh-compress scene.bvhx --codec zstd -o small.bvhx\n"
    "  bvh-compress scene.bvhx --codec topology -o smaller.bvhx\n"
    "  bvh-compress scene.bvhx --form quantized --record-bytes 8 -o small.bvhx\n"
    "  bvh-compress scene.bvhx --form two-level --blas-form ssh --blas-size 32 -o two-level.bvhx\n"
    "  bvh-compress scene.bvhx --max-slowdown 1.2 --pareto forms.csv -o compact.bvhx\n"
    "  bvh-compress scene.bvhx --geometry draco --position-bits 14 -o rounded.bvhx\n",
};

const std::vector<NamedValue> kGeometries = {
    {"raw", "vertices and indices as they are"},
    {"draco", "vertices rounded to a grid; boxes follow, and triangles keep their ids"},
};

/// The file's tree with the boxes that it is about: those of a compact form are larger.
Bvh exactTree(const BvhxFile& file) {
    const Bvh bvh = decode(file.bvh);
    return std::holds_alternative<AabbForm>(file.bvh) ? bvh : withExactBoxes(file.scene, bvh);
}

/// What `form` is made from: boxes as the file's form has them for aabb, which decodes; else exact ones, so
/// that they do not grow from one compact form to the next.
Bvh treeFor(std::string_view form, const BvhxFile& file) {
    return form == AabbForm::kName ? decode(file.bvh) : exactTree(file);
}

bool isInClusters(const EncodedBvh& bvh) {
    const auto* aabb = std::get_if<AabbForm>(&bvh);
    return std::holds_alternative<QuantizedShortForm>(bvh) || (aabb != nullptr && !aabb->bvh().slots.empty());
}

/// Whether the nodes are as bvh-build leaves them: all with full boxes.
bool isPlain(const EncodedBvh& bvh) {
    const EncodeOptions options = optionsOf(bvh);
    return std::holds_alternative<AabbForm>(bvh) ||
           (isInstanced(bvh) && options.tlasForm == TlasForm::aabb && options.blasForm == BlasForm::aabb);
}

/// The codecs of chunks, and one that squeezes the nodes of the aabb form as well.
std::vector<NamedValue> codecNames() {
    std::vector<NamedValue> names = namedValues(codecs());
    names.push_back({"topology", "zstd, and for form aabb nodes without boxes: fitted again when read"});
    return names;
}

const std::vector<NamedValue> kTriangleOrders = {
    {"source", "as they are"},
    {"leaf", "each geometry's as leaves have them; they keep their ids"},
};
const std::vector<NamedValue> kVertexOrders = {
    {"auto", "as they are; with draco, whichever is smaller"},
    {"source", "as they are"},
    {"use", "as triangles name them first"},
};

/// Puts each geometry's triangles in the order in which the tree's leaves have them.
void orderTrianglesByLeaves(BvhxFile& file) {
    Bvh bvh = decode(file.bvh);
    ReorderedScene reordered = withTrianglesInOrder(file.scene, bvh.primitives);
    AlignedVector<uint32_t> primitives(bvh.primitives.begin(), bvh.primitives.end());
    for (uint32_t& primitive : primitives) primitive = reordered.newIndex[primitive];
    bvh.primitives = std::move(primitives);
    file.scene = std::move(reordered.scene);
    file.bvh = choose(forms(), "form", formNameOf(file.bvh)).function(file.scene, bvh, optionsOf(file.bvh));
    file.unknownChunks.clear();  // they may know triangles by their old indices
}

/// Stores both levels of an instanced scene's trees in other forms.
void encodeInstances(BvhxFile& file, std::string_view form, const EncodeOptions& options, bool cuts) {
    if (form != TwoLevelForm::kName)
        throw Error(ErrorKind::usage,
                    "--form " + std::string(form) +
                        ": the scene has instances: use two-level, or build without --two-level");
    if (cuts)
        throw Error(ErrorKind::usage,
                    "--blas-size: the scene has instances, whose meshes are BLASes whole: leave it out");
    const EncodeOptions given = optionsOf(file.bvh), exact = exactLevels();
    if (given == options) return;
    InstancedBvh trees = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
    if (given != exact && options != exact)
        trees = mapTrees(file.scene, trees, [](const Scene& scene, const Bvh& tree, bool) {
            return withExactBoxes(scene, tree);
        });
    file.bvh = TwoLevelForm::encodeInstances(file.scene, trees, options);
    dropChunksThatDoNotSurvive(file, Change::reordered);
}

ExitCode compress(CommandLine& line) {
    std::string form, codec = "zstd", geometry(kGeometries[0].name), triangleOrder(kTriangleOrders[0].name),
                      vertexOrder(kVertexOrders[0].name);
    uint32_t level = 0, positionBits = 16;
    line.choice("--form", form, namedValues(forms()), "how nodes are stored");
    FormOptions formOptions(line);
    FormSearch search(line);
    line.choice("--codec", codec, codecNames(), "what squeezes the chunks");
    line.number("--level", level, 0, 19,
                "effort of the codec, 1 (fast) to 19 (small); 0: the codec's own default");
    line.choice("--geometry", geometry, kGeometries, "how the triangles are stored");
    line.number("--position-bits", positionBits, 1, 30, "bits a coordinate, for draco");
    line.choice("--triangle-order", triangleOrder, kTriangleOrders,
                "which triangles stand beside each other");
    line.choice("--vertex-order", vertexOrder, kVertexOrders, "which vertices stand beside each other");
    line.beginPlumbing();
    Pass pass(line, "INPUT", "the container; - or nothing: standard input");
    search.prepare(
        line, {"--codec", "--level", "--geometry", "--position-bits", "--triangle-order", "--vertex-order"});

    const bool topology = codec == "topology";
    if (topology && form.empty()) form = AabbForm::kName;
    if (topology && (form != AabbForm::kName || search.choosesForm()))
        throw Error(ErrorKind::usage,
                    "--codec topology: only --form aabb has boxes that fit again: use --codec zstd");
    // What suits BLASes is known when it is known whether they are meshes.
    if (!form.empty() && form != TwoLevelForm::kName) formOptions.check(form, {});
    BvhxFile file = pass.read();
    // A compact form stays what it is, unless told otherwise.
    const bool stays = form.empty() && !search.choosesForm() && !isPlain(file.bvh);
    if (form.empty() && !search.choosesForm())
        form = stays                   ? formNameOf(file.bvh)
               : isInstanced(file.bvh) ? TwoLevelForm::kName
                                       : QuantizedForm::kName;
    Report extra = Report::object();
    if (search.isWanted()) {
        pass.stages().begin("search");
        const bool onlyForm = search.choosesForm() && line.isGiven("--form");
        const TunedEncoding* chosen =
            search.search(file.scene, exactTree(file), onlyForm ? form : "", pass.stages().progress());
        if (search.choosesForm() && chosen == nullptr) {
            logError(search.refusal());
            return ExitCode::findings;
        }
        if (chosen != nullptr) search.assignTo(line);
        extra["search"] = search.report();
    }
    EncodeOptions defaults = stays ? optionsOf(file.bvh) : EncodeOptions{};
    if (!stays && file.scene.isInstanced())
        defaults.blasForm = BlasForm::quantized;  // for large trees mvh is slow
    formOptions.check(form, defaults);
    const bool isShort = form == QuantizedForm::kName && formOptions.isShort(isInClusters(file.bvh));
    EncodeOptions encoding = formOptions.fill(form, defaults);
    if (isShort) {
        form = QuantizedShortForm::kName;
        encoding.bits = EncodeOptions{}.bits;
    }
    pass.recordOptions(search.recordedOptions(line));
    pass.stages().begin("compress");
    if (file.scene.isInstanced()) {
        encodeInstances(file, form, encoding, line.isGiven("--blas-size"));
    } else if (formNameOf(file.bvh) != form || optionsOf(file.bvh) != encoding) {
        if (form == QuantizedShortForm::kName && !isInClusters(file.bvh))
            logInfo("the tree is put in clusters as bvh-relayout --layout clusters does");
        if (form == MvhForm::kName) logInfo("mvh builds a tree of its own from the triangles");
        file.bvh = choose(forms(), "form", form).function(file.scene, treeFor(form, file), encoding);
        dropChunksThatDoNotSurvive(file, Change::reordered);
    }
    if (triangleOrder == "leaf") orderTrianglesByLeaves(file);
    if (vertexOrder == "use") file.scene = withVerticesByUse(file.scene);
    WriteOptions options;
    options.codec = topology ? "zstd" : codec;
    options.nodes = topology ? NodeEncoding::topology : NodeEncoding::plain;
    options.codecLevel = int(level);
    options.geometry = geometry == "draco" ? GeometryEncoding::draco : GeometryEncoding::raw;
    options.dracoPositionBits = int(positionBits);
    options.dracoVertices = vertexOrder == "auto" ? VertexOrder::smaller : VertexOrder::kept;
    pass.finish(file, options, "compress", extra);
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, compress);
}
