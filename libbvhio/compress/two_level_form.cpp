#include "compress/two_level_form.h"

#include <algorithm>

#include "core/buffer.h"
#include "core/error.h"

namespace bvhio {
namespace {

/// make(a null pointer to the variant's alternative at an index).
template <class Variant, size_t I = 0, class Function>
auto makeAlternative(size_t index, const Function& make) {
    if constexpr (I + 1 < std::variant_size_v<Variant>)
        if (index != I) return makeAlternative<Variant, I + 1>(index, make);
    return make(static_cast<const std::variant_alternative_t<I, Variant>*>(nullptr));
}

/// The trees below the leaves of a top level, whose roots have the leaves' boxes.
Forest withBoxes(const Forest& forest, std::span<const Aabb> boxes) {
    Buffer<Node> roots(forest.roots.size());
    for (size_t i = 0; i < roots.size(); ++i) {
        roots[i] = forest.roots[i];
        roots[i].bounds = boxes[i];
    }
    return {std::move(roots).share(), forest.nodes};
}

template <class Level>
Level encodeTlas(const Scene& scene, const Bvh& top, const EncodeOptions& options) {
    return Level(Level::Form::encode(scene, top, options));
}

/// Primitives tree by tree, each with a box that must hold it there: of a triangle that was split, what is of
/// it in its leaf.
struct Runs {
    std::vector<uint32_t> primitives;
    std::vector<Aabb> boxes;
    std::vector<uint32_t>
        ordered;  // where a tree's run starts that has the shape of an MVH: its length, else 0
};

/// How many primitives are below a node that has the shape of an MVH; 0 if it has another.
uint32_t countOfMvh(const Forest& forest, const Node& node) {
    if (node.isLeaf()) return MvhRun{0, node.primitiveCount}.isLeaf() ? node.primitiveCount : 0;
    const uint32_t left = countOfMvh(forest, forest.nodes[node.left()]);
    const uint32_t right = left == 0 ? 0 : countOfMvh(forest, forest.nodes[node.right()]);
    const MvhRun run{0, left + right};
    return right != 0 && !run.isLeaf() && run.leftCount() == left ? run.count : 0;
}

/// Gathers each tree's primitives into one run, which the leaf of the top level then owns. A tree that has
/// the shape of an MVH, as one that was decoded, keeps its order.
Runs gatherRuns(const Scene& scene, TwoLevels& levels, std::span<const uint32_t> primitives) {
    Runs runs;
    runs.primitives.reserve(primitives.size());
    runs.boxes.reserve(primitives.size());
    std::vector<Node> waiting;
    std::vector<PrimitiveRange> ranges;
    for (const Node& root : levels.bottom.roots) {
        const auto first = uint32_t(runs.primitives.size());
        waiting = {root};
        while (!waiting.empty()) {
            const Node node = waiting.back();
            waiting.pop_back();
            if (!node.isLeaf()) {
                waiting.push_back(levels.bottom.nodes[node.right()]);
                waiting.push_back(levels.bottom.nodes[node.left()]);
                continue;
            }
            for (const uint32_t primitive : primitives.subspan(node.first, node.primitiveCount)) {
                Aabb box = bounds(scene.triangle(primitive));
                for (int axis = 0; axis < 3; ++axis) {
                    box.min[axis] = std::max(box.min[axis], node.bounds.min[axis]);
                    box.max[axis] = std::min(box.max[axis], node.bounds.max[axis]);
                }
                runs.primitives.push_back(primitive);
                runs.boxes.push_back(box);
            }
        }
        ranges.push_back({first, uint32_t(runs.primitives.size()) - first});
    }
    Buffer<Node> nodes(levels.top.nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = levels.top.nodes[i];
        nodes[i] = node;
        if (node.isLeaf()) nodes[i] = {node.bounds, ranges[node.first].first, ranges[node.first].count};
    }
    runs.ordered.resize(runs.primitives.size());
    for (size_t i = 0; i < ranges.size(); ++i)
        runs.ordered[ranges[i].first] = countOfMvh(levels.bottom, levels.bottom.roots[i]);
    levels.top.nodes = std::move(nodes).share();
    levels.top.primitives = std::vector<uint32_t>(runs.primitives);
    return runs;
}

void refuseTooDeep(const Bvh& bvh) {
    std::vector<uint8_t> depths(bvh.nodes.size() / 2);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1 || bvh.nodes[i].isLeaf()) continue;
        if (depths[i / 2] >= kMaxDepth)
            throw Error(ErrorKind::unsupported,
                        "the tree's lowest leaves lie too deep to be BLASes: use another --form or a larger "
                        "--blas-size");
        depths[bvh.nodes[i].left() / 2] = uint8_t(depths[i / 2] + 1);
    }
}

}  // namespace

TwoLevelForm TwoLevelForm::encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options) {
    TwoLevels levels = cutTree(bvh, options.blasSize);
    TwoLevelForm form =
        makeAlternative<Blases>(size_t(options.blasForm), [&](const auto* type) -> TwoLevelForm {
            using Bottom = std::decay_t<decltype(*type)>;
            Runs runs;
            if constexpr (Bottom::kAreRuns)
                runs = gatherRuns(scene, levels, bvh.primitives);
            else
                levels.top.primitives =
                    std::vector<uint32_t>{0};  // a top level of one leaf owns the one BLAS
            Tlas tlas = makeAlternative<Tlas>(size_t(options.tlasForm), [&](const auto* top) -> Tlas {
                return encodeTlas<std::decay_t<decltype(*top)>>(scene, levels.top, options);
            });
            const DecodedTlas top = std::visit([](const auto& level) { return level.decode(); }, tlas);
            if constexpr (Bottom::kAreRuns) {
                Bottom blases = Bottom::encode(top, runs.primitives, runs.boxes, runs.ordered);
                return {std::move(tlas), std::move(blases), std::move(runs.primitives), options.blasSize};
            } else {
                const Forest forest = withBoxes(levels.bottom, top.leafBoxes(levels.bottom.roots.size()));
                Bottom blases = Bottom::encode(forest, bvh.primitives.size());
                return {std::move(tlas), std::move(blases), bvh.primitives, options.blasSize};
            }
        });
    refuseTooDeep(form.decode());  // BLASes may be deeper than what they stand for
    return form;
}

Bvh TwoLevelForm::decode() const {
    const DecodedTlas top = std::visit([](const auto& level) { return level.decode(); }, tlas_);
    return std::visit(
        [&](const auto& level) -> Bvh {
            if constexpr (std::decay_t<decltype(level)>::kAreRuns)
                return level.decode(top, primitives_);
            else
                return joinLevels({top.bvh, level.decode(top.leafBoxes(level.roots().size()))}, primitives_);
        },
        blases_);
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
