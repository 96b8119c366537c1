#include "compress/quantized_form.h"

#include <algorithm>

#include "compress/divide_leaves.h"
#include "compress/inset_grid.h"
#include "compress/reference_limit.h"
#include "core/buffer.h"

namespace bvhio {
namespace {

/// What the two nodes of a record inherit: their parent's box, and its tree.
struct Parent {
    InsetBox box;
    size_t tree = 0;
};

InsetGrid gridIn(const RootPlaces& places, const Parent& parent, uint32_t bits) {
    return {places.frame(parent.tree), parent.box, places.bounds[parent.tree], bits};
}

/// Returns the records of trees whose nodes below the roots are `nodes`, in slots from `firstSlot` on.
Buffer<QuantizedRecord> encodeRecords(std::span<const Node> roots, std::span<const Node> nodes,
                                      uint32_t firstSlot, const RootPlaces& places, uint32_t bits) {
    Buffer<QuantizedRecord> records(nodes.size() / 2);
    std::vector<Parent> parents(records.size());
    const auto recordBelow = [&](const Node& node) { return (node.left() - firstSlot) / 2; };
    for (size_t i = 0; i < roots.size(); ++i)
        if (!roots[i].isLeaf()) parents[recordBelow(roots[i])] = {places.insets[i], i};
    for (size_t r = 0; r < records.size(); ++r) {
        const Node* pair = &nodes[2 * r];
        const InsetGrid grid = gridIn(places, parents[r], bits);
        QuantizedRecord record{};
        grid.setPlanes(record, pair[0].bounds, pair[1].bounds);
        for (uint32_t child = 0; child < 2; ++child) {
            const Node& node = pair[child];
            if (node.isLeaf()) {
                record.setLeaf(child, node.first, node.primitiveCount);
            } else {
                record.setInner(child, recordBelow(node));
                parents[recordBelow(node)] = {grid.child(record, child), parents[r].tree};
            }
        }
        records[r] = record;
    }
    return records;
}

/// Returns the node of a child with this word.
Node nodeOf(uint32_t word, uint32_t highBits, const Aabb& bounds, uint32_t firstSlot) {
    if (QuantizedRecord::isLeaf(word))
        return {bounds, QuantizedRecord::firstPrimitive(word),
                QuantizedRecord::primitiveCount(word, uint8_t(highBits))};
    return {bounds, 2 * QuantizedRecord::record(word) + firstSlot, 0};
}

/// Decodes records to the nodes of slots from `firstSlot` on, and writes the boxes as insets too, unless
/// `insets` is null. Records of children come after those of their parents.
void decodeRecords(std::span<const QuantizedRoot> roots, std::span<const QuantizedRecord> records,
                   uint32_t firstSlot, const RootPlaces& places, uint32_t bits, Node* nodes,
                   InsetBox* insets) {
    std::vector<Parent> parents(records.size());
    for (size_t i = 0; i < roots.size(); ++i)
        if (!QuantizedRecord::isLeaf(roots[i].word) && !records.empty())
            parents[QuantizedRecord::record(roots[i].word)] = {places.insets[i], i};
    for (size_t r = 0; r < records.size(); ++r) {
        const QuantizedRecord& record = records[r];
        const size_t tree = parents[r].tree;
        const InsetGrid grid = gridIn(places, parents[r], bits);
        for (uint32_t child = 0; child < 2; ++child) {
            const InsetBox box = grid.child(record, child);
            const uint32_t word = record.children[child];
            nodes[2 * r + child] = nodeOf(word, record.highBits(child), places.floats(tree, box), firstSlot);
            if (insets != nullptr) insets[2 * r + child] = box;
            if (!QuantizedRecord::isLeaf(word)) parents[QuantizedRecord::record(word)] = {box, tree};
        }
    }
}

/// Returns the place of a single tree.
RootPlaces placesOf(const Aabb& bounds) {
    return {{InsetFrame(bounds)}, {bounds}, {InsetBox{}}, {}};
}

}  // namespace

std::span<const FormOption<QuantizedForm::Options>> QuantizedForm::optionTable() {
    static constexpr FormOption<Options> kTable[] = {
        memberOption<&Options::bits>({.name = "--bits",
                                      .help = "bits per plane",
                                      .min = QuantizedRecord::kMinBits,
                                      .max = QuantizedRecord::kMaxBits})};
    return kTable;
}

QuantizedForm QuantizedForm::encode(const Scene&, const Bvh& given, const Options& options) {
    refuseMoreThan(QuantizedRecord::kMaxReferences, given.primitives.size(), kName);
    const Bvh bvh = divideLeaves(given, QuantizedRecord::kMaxLeafSize);
    const std::span<const Node> nodes = bvh.nodes;
    const Aabb& bounds = nodes[0].bounds;
    return {bounds, options.bits,
            encodeRecords(nodes.first(1), nodes.subspan(2), 2, placesOf(bounds), options.bits).share(),
            bvh.primitives};
}

Bvh QuantizedForm::decode(InsetBox* insets) const {
    Buffer<Node> nodes(2 * records_.size() + 2);
    nodes[0] = {bounds_, 2, 0};
    if (records_.empty()) nodes[0] = {bounds_, 0, uint32_t(primitives_.size())};
    nodes[1] = {};
    const QuantizedRoot root{};
    decodeRecords({&root, 1}, records_, 2, placesOf(bounds_), bits_, nodes.data() + 2,
                  insets == nullptr ? nullptr : insets + 2);
    return {std::move(nodes).share(), primitives_};
}

QuantizedForm::Trees QuantizedForm::encodeTrees(const Forest& given, const RootPlaces& places,
                                                size_t references, uint32_t bits) {
    refuseMoreThan(QuantizedRecord::kMaxReferences, references, kName);
    const Forest forest = divideLeaves(given, QuantizedRecord::kMaxLeafSize);
    Buffer<QuantizedRoot> roots(forest.roots.size());
    for (size_t i = 0; i < roots.size(); ++i) {
        const Node& node = forest.roots[i];
        QuantizedRecord asChild{};
        if (node.isLeaf())
            asChild.setLeaf(0, node.first, node.primitiveCount);
        else
            asChild.setInner(0, node.left() / 2);
        roots[i] = {asChild.children[0], asChild.highBits(0)};
    }
    return {std::move(roots).share(), encodeRecords(forest.roots, forest.nodes, 0, places, bits).share()};
}

Forest QuantizedForm::decodeTrees(const Trees& trees, const RootPlaces& places, uint32_t bits) {
    Buffer<Node> roots(trees.roots.size()), nodes(2 * trees.records.size());
    for (size_t i = 0; i < roots.size(); ++i)
        roots[i] = nodeOf(trees.roots[i].word, trees.roots[i].highBits, places.bounds[i], 0);
    decodeRecords(trees.roots, trees.records, 0, places, bits, nodes.data(), nullptr);
    return {std::move(roots).share(), std::move(nodes).share()};
}

}  // namespace bvhio
