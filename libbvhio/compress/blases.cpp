#include "compress/blases.h"

#include "core/buffer.h"

namespace bvhio {

AabbBlases AabbBlases::encode(const Forest& forest, size_t) {
    Buffer<Root> roots(forest.roots.size());
    for (size_t i = 0; i < roots.size(); ++i)
        roots[i] = {forest.roots[i].first, forest.roots[i].primitiveCount};
    return {std::move(roots).share(), forest.nodes};
}

Forest AabbBlases::decode(std::span<const Aabb> boxes) const {
    Buffer<Node> roots(roots_.size());
    for (size_t i = 0; i < roots.size(); ++i)
        roots[i] = {boxes[i], roots_[i].first, roots_[i].primitiveCount};
    return {std::move(roots).share(), nodes()};
}

SshBlases SshBlases::encode(const Forest& forest, size_t references) {
    SshForm::Trees trees = SshForm::encodeTrees(forest, references);
    return {std::move(trees.roots), std::move(trees.nodes)};
}

Forest SshBlases::decode(std::span<const Aabb> boxes) const {
    return SshForm::decodeTrees({roots_, nodes()}, boxes);
}

}  // namespace bvhio
