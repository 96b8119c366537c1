#include "file/change_trees.h"

namespace bvhio {

void changeTrees(BvhxFile& file, const TreeFunction& function) {
    if (!file.scene.isInstanced()) {
        file.bvh = AabbForm(function(file.scene, decode(file.bvh), false));
        return;
    }
    const InstancedBvh trees = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
    file.bvh = TwoLevelForm::encodeInstances(file.scene, mapTrees(file.scene, trees, function),
                                             TwoLevelForm::exactLevels());
}

}  // namespace bvhio
