#include "compress/two_level_form.h"

#include "core/buffer.h"

namespace bvhio {
namespace {

template <class Variant, size_t I = 0, class Function>
Variant makeAlternative(size_t index, const Function& make) {
    if constexpr (I + 1 < std::variant_size_v<Variant>)
        if (index != I) return makeAlternative<Variant, I + 1>(index, make);
    return make(static_cast<const std::variant_alternative_t<I, Variant>*>(nullptr));
}

/// The boxes of a top level's leaves, by what the leaves name.
std::vector<Aabb> leafBoxes(const Bvh& top, size_t leaves) {
    std::vector<Aabb> boxes(leaves);
    for (const Node& node : top.nodes)
        if (node.isLeaf()) boxes[node.first] = node.bounds;
    return boxes;
}

Forest withBoxes(const Forest& forest, std::span<const Aabb> boxes) {
    Buffer<Node> roots(forest.roots.size());
    for (size_t i = 0; i < roots.size(); ++i) {
        roots[i] = forest.roots[i];
        roots[i].bounds = boxes[i];
    }
    return {std::move(roots).share(), forest.nodes};
}

}  // namespace

TwoLevelForm TwoLevelForm::encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options) {
    const TwoLevels levels = cutTree(bvh, options.blasSize);
    Tlas tlas = makeAlternative<Tlas>(size_t(options.tlasForm), [&](const auto* type) -> Tlas {
        using Level = std::decay_t<decltype(*type)>;
        return Level(Level::Form::encode(scene, levels.top, options));
    });
    const Bvh top = std::visit([](const auto& level) { return level.form().decode(); }, tlas);
    const Forest forest = withBoxes(levels.bottom, leafBoxes(top, levels.bottom.roots.size()));
    Blases blases = makeAlternative<Blases>(size_t(options.blasForm), [&](const auto* type) -> Blases {
        return std::decay_t<decltype(*type)>::encode(forest, bvh.primitives.size());
    });
    return {std::move(tlas), std::move(blases), bvh.primitives, options.blasSize};
}

Bvh TwoLevelForm::decode() const {
    const Bvh top = std::visit([](const auto& level) { return level.form().decode(); }, tlas_);
    Forest bottom = std::visit(
        [&](const auto& level) { return level.decode(leafBoxes(top, level.roots().size())); }, blases_);
    return joinLevels({top, std::move(bottom)}, primitives_);
}

EncodeOptions TwoLevelForm::options() const {
    EncodeOptions options = std::visit([](const auto& level) { return level.form().options(); }, tlas_);
    options.tlasForm = TlasForm(tlas_.index());
    options.blasForm = BlasForm(blases_.index());
    options.blasSize = blasSize_;
    return options;
}

size_t TwoLevelForm::tlasBytes() const {
    return std::visit([](const auto& level) { return level.form().nodeBytes(); }, tlas_);
}

size_t TwoLevelForm::nodeBytes() const {
    return tlasBytes() + std::visit([](const auto& level) { return level.nodeBytes(); }, blases_);
}

}  // namespace bvhio
