#include "compress/mvh_form.h"

#include "compress/mvh_build.h"
#include "core/buffer.h"
#include "core/parallel.h"

namespace bvhio {
namespace {

/// Returns the slot of a node in the canonical tree, whose slot 1 is unused.
uint32_t slotOf(uint32_t node) {
    return node == 0 ? 0 : node + 1;
}

/// The rules to choose from for each tree.
std::vector<MvhRule> candidates(const MvhForm::Options& options) {
    const bool isPaper = options.build == MvhBuild::paper;
    const uint32_t axes = options.cutAxes > 0 ? options.cutAxes : isPaper ? 1 : 3;
    if (options.zeta > 0) {
        const float both = options.zetaOfBoth > 0 ? options.zetaOfBoth : options.zeta;
        return {{options.zeta, std::min(both, MvhRule::kMaxZetaOfBoth), axes}};
    }
    std::vector<MvhRule> rules;
    if (isPaper) {
        for (const float zeta : {0.35f, 0.25f, 0.3f, 0.4f, 0.45f}) rules.push_back({zeta, zeta, axes});
    } else {
        for (const float one : {0.45f, 0.35f, 0.4f, 0.5f})
            for (const float both : {0.3f, 0.25f, 0.35f, 0.4f}) rules.push_back({one, both, axes});
    }
    return rules;
}

/// References in the order of a tree's leaves, and the rule that cuts its boxes.
struct Tree {
    std::vector<MvhReference> references;
    MvhCoder coder;
    MvhRule rule;
    double cost = 0;

    /// Picks the rule with the least SAH cost.
    Tree(std::vector<MvhReference> given, const Aabb& root, uint32_t leafSize, std::span<const MvhRule> rules)
        : references(std::move(given)), coder(references, root, leafSize) {
        std::vector<double> costs(rules.size());
        parallelChunks(rules.size(), 1, [&](size_t i, size_t) { costs[i] = coder.cost(rules[i]); });
        const auto least = size_t(std::min_element(costs.begin(), costs.end()) - costs.begin());
        rule = rules[least];
        cost = costs[least];
    }
};

Tree buildTree(std::vector<MvhReference> references, const Aabb& root, const MvhForm::Options& options) {
    const std::vector<MvhRule> rules = candidates(options);
    orderMvh(references, root, {options.leafSize, rules[0]}, options.build);
    return {std::move(references), root, options.leafSize, rules};
}

/// The best of three: greedy builds are some percent apart by luck, and most so by how many axes take turns.
/// The paper's is rarely the one.
Tree bestTree(const std::vector<MvhReference>& references, const Aabb& root, MvhForm::Options options) {
    const bool chooses = options.cutAxes == 0;
    if (chooses) options.cutAxes = 3;
    Tree best = buildTree(references, root, options);
    const auto challenge = [&] {
        Tree tree = buildTree(references, root, options);
        if (tree.cost < best.cost) best = std::move(tree);
    };
    if (chooses) {
        options.cutAxes = 2;
        challenge();
        options.cutAxes = 0;
    }
    options.build = MvhBuild::paper;
    challenge();
    return best;
}

/// Returns whether a tree has the shape of a tree that this form decodes to.
bool hasShape(const Bvh& bvh, const MvhShape& shape) {
    if (bvh.nodes.size() != size_t(shape.nodeCount()) + 1 || bvh.primitives.size() != shape.primitiveCount())
        return false;
    for (uint32_t i = 0; i < shape.nodeCount(); ++i) {
        const Node& node = bvh.nodes[slotOf(i)];
        const PrimitiveRange expected =
            shape.isLeaf(i) ? shape.primitiveRange(i) : PrimitiveRange{slotOf(2 * i + 1), 0};
        if (node.first != expected.first || node.primitiveCount != expected.count) return false;
    }
    return true;
}

}  // namespace

MvhForm MvhForm::encode(const Scene& scene, const Bvh& bvh, const Options& options) {
    const auto count = uint32_t(scene.triangles.size());
    const MvhShape shape(count, options.leafSize);
    std::vector<MvhReference> references = mvhReferences(scene);
    Aabb root = Aabb::empty();
    for (const MvhReference& r : references) root.extend(r.box());
    const bool keeps = options.build == MvhBuild::given && hasShape(bvh, shape);
    if (keeps) {
        std::vector<MvhReference> ordered(count);
        for (size_t i = 0; i < count; ++i) ordered[i] = references[bvh.primitives[i]];
        references = std::move(ordered);
    }
    const Tree tree = keeps ? Tree(std::move(references), root, options.leafSize, candidates(options))
                      : options.build == MvhBuild::paper ? buildTree(std::move(references), root, options)
                                                         : bestTree(references, root, options);

    std::vector<uint8_t> nibbles(shape.innerCount());
    tree.coder.code(tree.rule, nibbles.data());
    std::vector<uint32_t> words(wordCount(shape)), primitives(count);
    for (size_t i = 0; i < nibbles.size(); ++i) words[i / 8] |= uint32_t(nibbles[i]) << i % 8 * 4;
    for (size_t i = 0; i < count; ++i) primitives[i] = tree.references[i].primitive;
    return {root, {options.leafSize, tree.rule}, std::move(words), std::move(primitives)};
}

Bvh MvhForm::decode() const {
    Buffer<Node> nodes(size_t(shape_.nodeCount()) + 1);
    Buffer<uint8_t> turns(nodes.size());
    nodes[1] = {};
    nodes[0].bounds = bounds_;
    turns[0] = 0;
    for (uint32_t i = 0; i < shape_.nodeCount(); ++i) {
        const uint32_t slot = slotOf(i);
        Node& node = nodes[slot];
        if (shape_.isLeaf(i)) {
            const PrimitiveRange range = shape_.primitiveRange(i);
            node.first = range.first;
            node.primitiveCount = range.count;
            continue;
        }
        node.first = slotOf(2 * i + 1);
        node.primitiveCount = 0;
        const MvhBox box{node.bounds, turns[slot]};
        const MvhCuts cuts(box, parameters_.rule);
        const uint32_t codes = mvhNibble(words_.data(), i);
        for (const uint32_t child : {0, 1}) {
            const MvhBox childBox = cuts.child(box, codes >> 2 * child & 3);
            nodes[node.first + child].bounds = childBox.bounds;
            turns[node.first + child] = uint8_t(childBox.turn);
        }
    }
    return {std::move(nodes).share(), primitives_};
}

}  // namespace bvhio
