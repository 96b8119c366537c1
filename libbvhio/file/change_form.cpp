#include "file/change_form.h"

#include "compress/exact_boxes.h"
#include "scene/scene_order.h"

namespace bvhio {
namespace {

/// What `form` is made from: boxes as the file's form has them for an exact form, which decodes; else exact
/// ones, so that they do not grow from one compact form to the next.
Bvh treeFor(std::string_view form, const BvhxFile& file) {
    return traitsOf(form).isExact ? decode(file.bvh) : exactTree(file);
}

/// Whether the nodes are as bvh-build leaves them: all with full boxes.
bool isPlain(const EncodedBvh& bvh) {
    return traitsOf(bvh).isExact ||
           (isInstanced(bvh) && optionsOf(bvh) == EncodeOptions(TwoLevelForm::exactLevels()));
}

/// Stores both levels of an instanced scene's trees in other forms.
void changeLevels(BvhxFile& file, const std::string& form, const EncodeOptions& options) {
    if (!traitsOf(form).holdsInstances)
        throw Error(ErrorKind::usage,
                    "form " + form + ": the scene has instances: use two-level, or build without them");
    const EncodeOptions given = optionsOf(file.bvh), exact = TwoLevelForm::exactLevels();
    if (given == options) return;
    InstancedBvh trees = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
    if (given != exact && options != exact)
        trees = mapTrees(file.scene, trees, [](const Scene& scene, const Bvh& tree, bool) {
            return withExactBoxes(scene, tree);
        });
    file.bvh = TwoLevelForm::encodeInstances(file.scene, trees, optionsFor<TwoLevelForm>(options));
    dropChunksThatDoNotSurvive(file, Change::reordered);
}

}  // namespace

const FormTraits& traitsOf(std::string_view form) {
    return choose(forms(), "form", form).function.traits;
}

Bvh exactTree(const BvhxFile& file) {
    const Bvh bvh = decode(file.bvh);
    return traitsOf(file.bvh).isExact ? bvh : withExactBoxes(file.scene, bvh);
}

EncodeOptions settleForm(std::string& form, const BvhxFile& file) {
    const bool isInstanced = file.scene.isInstanced();
    if (form.empty() && !isPlain(file.bvh)) {
        form = formNameOf(file.bvh);
        return optionsOf(file.bvh);
    }
    if (form.empty()) form = isInstanced ? TwoLevelForm::kName : QuantizedForm::kName;
    if (isInstanced && traitsOf(form).holdsInstances)
        return TwoLevelForm::Options{.blasForm = BlasForm::quantized};  // for large trees mvh is slow
    return {};
}

bool isStoredAs(const EncodedBvh& bvh, std::string_view form, const EncodeOptions& options) {
    return formNameOf(bvh) == form && optionsOf(bvh) == options;
}

void changeForm(BvhxFile& file, const std::string& form, const EncodeOptions& options) {
    if (file.scene.isInstanced()) return changeLevels(file, form, options);
    if (isStoredAs(file.bvh, form, options)) return;
    file.bvh = choose(forms(), "form", form).function(file.scene, treeFor(form, file), options);
    dropChunksThatDoNotSurvive(file, Change::reordered);
}

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

}  // namespace bvhio
