// bvh-compress: chooses how a container's tree is stored, and squeezes its chunks.
#include "common/pass.h"
#include "common/run_tool.h"
#include "compress/exact_boxes.h"
#include "file/codecs.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-compress",
    "Stores a container's tree in another form, and squeezes its chunks.",
    "  bvh-compress scene.bvhx --codec zstd -o small.bvhx\n"
    "  bvh-compress scene.bvhx --codec topology -o smaller.bvhx\n"
    "  bvh-compress scene.bvhx --geometry draco --position-bits 14 -o rounded.bvhx\n",
};

const std::vector<NamedValue> kGeometries = {
    {"raw", "vertices and indices as they are"},
    {"draco", "vertices rounded to a grid; boxes follow, and triangles keep their ids"},
};

/// What `form` is made from: boxes as the file's form has them for aabb, which decodes; else exact ones, so
/// that they do not grow from one compact form to the next.
Bvh treeFor(std::string_view form, const BvhxFile& file) {
    const Bvh bvh = decode(file.bvh);
    const bool isCompact = !std::holds_alternative<AabbForm>(file.bvh);
    return isCompact && form != AabbForm::kName ? withExactBoxes(file.scene, bvh) : bvh;
}

/// The codecs of chunks, and one that squeezes the nodes of the aabb form as well.
std::vector<NamedValue> codecNames() {
    std::vector<NamedValue> names = namedValues(codecs());
    names.push_back({"topology", "zstd, and for form aabb nodes without boxes: fitted again when read"});
    return names;
}

ExitCode compress(CommandLine& line) {
    std::string form(forms()[0].name), codec = "zstd", geometry(kGeometries[0].name);
    uint32_t level = 0, positionBits = 16;
    line.choice("--form", form, namedValues(forms()), "how nodes are stored");
    line.choice("--codec", codec, codecNames(), "what squeezes the chunks");
    line.number("--level", level, 0, 22, "the codec's effort; 0: its own default");
    line.choice("--geometry", geometry, kGeometries, "how the triangles are stored");
    line.number("--position-bits", positionBits, 1, 30, "bits a coordinate, for draco");
    Pass pass(line, "INPUT", "the container; - or nothing: standard input");

    const bool topology = codec == "topology";
    if (topology && form != AabbForm::kName)
        throw Error(ErrorKind::usage,
                    "--codec topology: only --form aabb has boxes that fit again: use --codec zstd");
    BvhxFile file = pass.read();
    pass.stages().begin("compress");
    const EncodeOptions encoding;
    if (formNameOf(file.bvh) != form || optionsOf(file.bvh) != encoding) {
        file.bvh = choose(forms(), "form", form).function(file.scene, treeFor(form, file), encoding);
        dropChunksThatDoNotSurvive(file, Change::reordered);
    }
    WriteOptions options;
    options.codec = topology ? "zstd" : codec;
    options.nodes = topology ? NodeEncoding::topology : NodeEncoding::plain;
    options.codecLevel = int(level);
    options.geometry = geometry == "draco" ? GeometryEncoding::draco : GeometryEncoding::raw;
    options.dracoPositionBits = int(positionBits);
    pass.finish(file, options, "compress");
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, compress);
}
