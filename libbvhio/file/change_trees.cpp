#include "file/change_trees.h"

namespace bvhio {

EncodeOptions exactLevels() {
    EncodeOptions options;
    options.tlasForm = TlasForm::aabb;
    options.blasForm = BlasForm::aabb;
    return options;
}

void changeTrees(BvhxFile& file, const TreeFunction& function) {
    if (!file.scene.isInstanced()) {
        file.bvh = AabbForm(function(file.scene, decode(file.bvh), false));
        return;
    }
    const InstancedBvh trees = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
    file.bvh =
        TwoLevelForm::encodeInstances(file.scene, mapTrees(file.scene, trees, function), exactLevels());
}

}  // namespace bvhio
