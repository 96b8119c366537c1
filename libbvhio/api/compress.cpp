// Storing trees in other forms, and choosing how they are saved.
#include "api/pass.h"
#include "compress/form_options.h"
#include "file/change_form.h"
#include "scene/scene_order.h"

namespace bvhio {
namespace {

constexpr std::string_view kGeometryNames[] = {"raw", "draco"};
constexpr std::string_view kTriangleOrderNames[] = {"source", "leaf"};
constexpr std::string_view kVertexOrderNames[] = {"auto", "source", "use"};
constexpr std::string_view kTopology = "topology";  // zstd, and nodes without boxes

std::vector<std::string_view> codecNames() {
    std::vector<std::string_view> names;
    for (const Codec& codec : codecs()) names.push_back(codec.name);
    names.push_back(kTopology);
    return names;
}

/// Forms name their options as command lines do.
std::string_view withoutDashes(std::string_view name) {
    return name.substr(name.find_first_not_of('-'));
}

/// Asks for the options of all forms, so that each is known; those of other forms than `form` must not be
/// given.
void askForForms(OptionList& list, std::string_view form) {
    for (const FormChoice& other : forms())
        visitForm(other.name, [&]<class Form>(std::type_identity<Form>) {
            for (const OptionInfo& option : Form::optionTable()) list.mention(withoutDashes(option.name));
        });
    list.refuseUnknown();
    visitForm(form, [&]<class Form>(std::type_identity<Form>) {
        for (const std::string& name : list.mentioned()) {
            const auto isOfForm = [&](const OptionInfo& option) {
                return withoutDashes(option.name) == name;
            };
            if (std::none_of(Form::optionTable().begin(), Form::optionTable().end(), isOfForm))
                list.refuseUnused(name, "form " + std::string(form));
        }
    });
}

/// The options of the form: `defaults` with what was given. Records those that the tree depends on.
EncodeOptions optionsOfForm(OptionList& list, std::string_view form, const EncodeOptions& defaults) {
    return visitForm(form, [&]<class Form>(std::type_identity<Form>) -> EncodeOptions {
        auto options = optionsFor<Form>(defaults);
        for (const auto& option : Form::optionTable())
            if (const std::string_view name = withoutDashes(option.name); list.isGiven(name))
                option.set(options, valueOf(option, list.text(name, "")));
        for (const auto& option : Form::optionTable()) {
            const std::string_view name = withoutDashes(option.name);
            if (!option.isUsed(options)) {
                list.refuseUnused(name, "this " + std::string(form) + " tree");
                continue;
            }
            const OptionValue value = option.get(options);
            if (option.kind == OptionKind::number)
                list.record(name, value.number);
            else
                list.record(name, option.kind == OptionKind::choice
                                      ? std::string(option.values[value.number].name)
                                      : value.text);
        }
        return options;
    });
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" BvhioStatus bvhioCompress(const BvhioContainer* container, const char* const* options,
                                     const BvhioContext* context, BvhioContainer** result) {
    return runPass(
        "compress", container, options, context, result, [&](OptionList& list, Progress& progress) {
            std::string form = list.text("form", "");
            const std::string codec = list.choice("codec", "zstd", codecNames());
            const uint32_t level = list.number("level", 0u, 0u, 19u);
            const bool isDraco =
                list.choice("geometry", kGeometryNames[0], kGeometryNames) == kGeometryNames[1];
            const uint32_t positionBits = list.number("position-bits", 16u, 1u, 30u);
            const std::string triangles =
                list.choice("triangle-order", kTriangleOrderNames[0], kTriangleOrderNames);
            const std::string vertices = list.choice("vertex-order", kVertexOrderNames[0], kVertexOrderNames);
            const bool isTopology = codec == kTopology;

            auto content = std::make_shared<Content>(contentOf(container).file);
            BvhxFile& file = content->file;
            if (isTopology && form.empty()) form = forms()[0].name;
            if (isTopology && !traitsOf(form).isExact)
                throw Error(ErrorKind::usage,
                            "option codec: topology is for form aabb, whose boxes fit again: use zstd");
            const EncodeOptions defaults = settleForm(form, file);
            askForForms(list, form);
            if (file.scene.isInstanced()) list.refuseUnused("blas-size", "a scene with instances");
            list.record("form", form);
            const EncodeOptions encoding = optionsOfForm(list, form, defaults);

            progress.start(2);
            progress.add(1);
            changeForm(file, form, encoding);
            if (triangles == "leaf") orderTrianglesByLeaves(file);
            if (vertices == "use") file.scene = withVerticesByUse(file.scene);
            content->writing = {
                .codec = isTopology ? "zstd" : codec,
                .codecLevel = int(level),
                .nodes = isTopology ? NodeEncoding::topology : NodeEncoding::plain,
                .geometry = isDraco ? GeometryEncoding::draco : GeometryEncoding::raw,
                .dracoPositionBits = int(positionBits),
                .dracoVertices = vertices == "auto" ? VertexOrder::smaller : VertexOrder::kept};
            progress.add(1);
            return content;
        });
}
