#include "api/content.h"

namespace bvhio {

const std::vector<Bvh>& Content::trees() const {
    std::call_once(decoded_, [&] {
        std::vector<Bvh> trees;
        if (isInstanced(file.bvh)) {
            InstancedBvh levels = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
            trees.push_back(std::move(levels.top));
            for (Bvh& mesh : levels.meshes) trees.push_back(std::move(mesh));
        } else {
            trees.push_back(decode(file.bvh));
        }
        trees_ = std::move(trees);
    });
    return trees_;
}

}  // namespace bvhio
