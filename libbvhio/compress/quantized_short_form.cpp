#include "compress/quantized_short_form.h"

#include <algorithm>
#include <vector>

#include "compress/divide_leaves.h"
#include "compress/inset_grid.h"
#include "compress/reference_limit.h"
#include "core/buffer.h"
#include "core/error.h"
#include "tree/clusters.h"

namespace bvhio {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;

uint32_t pairBelow(const Node& node) {
    return node.left() / 2 - 1;
}

/// The slots of each pair in a slot map.
struct PairSlots {
    std::vector<uint32_t> records, glue;  // kNone: the pair has no such slot

    explicit PairSlots(const Bvh& bvh) : records(bvh.nodes.size() / 2 - 1, kNone), glue(records) {
        for (size_t slot = 0; slot < bvh.slots.words.size(); ++slot) {
            const uint32_t word = bvh.slots.words[slot];
            if (word == SlotMap::kEmpty) continue;
            if ((word & SlotMap::kGlue) != 0)
                glue[word & ~SlotMap::kGlue] = uint32_t(slot);
            else
                records[word] = uint32_t(slot);
        }
    }
    /// Returns the slot that the parent's record refers to.
    uint32_t named(uint32_t pair) const { return glue[pair] != kNone ? glue[pair] : records[pair]; }
    bool startsCluster(uint32_t pair) const { return pair == 0 || glue[pair] != kNone; }
};

/// Returns whether the leaf entries of every cluster are within reach of its references.
bool entriesAreInReach(const Bvh& bvh) {
    const PairSlots at(bvh);
    uint32_t entries = 0;
    for (const uint32_t word : bvh.slots.words) {
        if ((word & SlotMap::kGlue) != 0) continue;  // glue or empty
        if (at.startsCluster(word)) entries = 0;
        for (uint32_t child = 0; child < 2; ++child)
            entries += bvh.nodes[2 * word + 2 + child].primitiveCount;
        if (entries > SlotMap::maxEntries(bvh.slots.pointerBits)) return false;
    }
    return true;
}

/// The tree with leaves that fit, in clusters that do: its own where they are right.
Bvh inClusters(const Bvh& given, const QuantizedShortForm::Options& options) {
    Bvh bvh = divideLeaves(given, ShortRecord::kMaxLeafSize);
    if (bvh.nodes.size() == given.nodes.size()) bvh.slots = given.slots;
    if (!bvh.slots.empty() && validateSlots(bvh).empty() && entriesAreInReach(bvh)) return bvh;
    ClusterOptions wanted;
    const bool wasClustered = !given.slots.empty();
    wanted.pointerBits = wasClustered ? given.slots.pointerBits : options.pointerBits;
    wanted.lineSlots =
        wasClustered ? given.slots.lineSlots : options.lineSize / uint32_t(sizeof(ShortRecord));
    bvh.slots = makeClusters(bvh, wanted);
    return bvh;
}

/// Marks the last entry of each leaf in a bitmap. Returns no bitmap if each leaf owns one entry.
SharedArray<uint32_t> markLastEntries(const std::vector<uint32_t>& leafSizes, size_t references) {
    if (leafSizes.size() == references) return {};
    std::vector<uint32_t> words(QuantizedShortForm::lastEntryWords(references));
    uint32_t next = 0;
    for (const uint32_t size : leafSizes) {
        next += size;
        words[(next - 1) / 32] |= 1u << (next - 1) % 32;
    }
    return words;
}

}  // namespace

std::span<const FormOption<QuantizedShortForm::Options>> QuantizedShortForm::optionTable() {
    constexpr auto kMaxLineSize = uint32_t(SlotMap::kMaxLineSlots * sizeof(ShortRecord));
    static constexpr FormOption<Options> kTable[] = {
        memberOption<&Options::pointerBits>({.name = "--pointer-bits",
                                             .help = "bits of a pointer within a new cluster",
                                             .min = SlotMap::kMinPointerBits,
                                             .max = SlotMap::kMaxPointerBits,
                                             .isEveryday = false}),
        memberOption<&Options::lineSize>({.name = "--line-size",
                                          .help = "bytes of a cache line, where new clusters start",
                                          .min = sizeof(ShortRecord),
                                          .max = kMaxLineSize,
                                          .isEveryday = false})};
    return kTable;
}

QuantizedShortForm QuantizedShortForm::encode(const Scene&, const Bvh& given, const Options& options) {
    refuseMoreThan(ShortRecord::kMaxReferences, given.primitives.size(), kName);
    const Bvh bvh = inClusters(given, options);
    const SlotMap& map = bvh.slots;
    const Aabb& bounds = bvh.nodes[0].bounds;
    const InsetFrame frame(bounds);
    const PairSlots at(bvh);
    const uint32_t firstLeaf = 1u << map.pointerBits;

    // Visit slots in order: parents come before their children, and glue before its cluster.
    Buffer<ShortRecord> slots(map.words.size());
    std::vector<InsetBox> boxes(at.records.size());  // of each pair's parent
    AlignedVector<uint32_t> primitives(bvh.primitives.size());
    std::vector<uint32_t> leafSizes;
    leafSizes.reserve(boxes.size() + 1);
    uint32_t cluster = 0, clustersFirst = 0, next = 0;  // slot, entry, entry
    const auto own = [&](const Node& leaf) {
        std::copy_n(bvh.primitives.begin() + leaf.first, leaf.primitiveCount, primitives.begin() + next);
        leafSizes.push_back(leaf.primitiveCount);
        next += leaf.primitiveCount;
    };
    std::vector<uint32_t> firstOf(bvh.nodes.size());  // of leaves
    std::vector<uint32_t> waiting;                    // nodes, the next one last
    // Appends the entries of all leaves of a cluster, depth first: what is near in the tree is near in space.
    const auto ownLeavesFrom = [&](uint32_t root) {
        waiting.assign({2 * root + 3, 2 * root + 2});
        while (!waiting.empty()) {
            const uint32_t index = waiting.back();
            waiting.pop_back();
            const Node& node = bvh.nodes[index];
            if (node.isLeaf()) {
                firstOf[index] = next;
                own(node);
            } else if (!at.startsCluster(pairBelow(node))) {
                waiting.insert(waiting.end(), {node.right(), node.left()});
            }
        }
    };
    for (size_t slot = 0; slot < slots.size(); ++slot) {
        slots[slot] = {};
        const uint32_t pair = map.words[slot];
        if ((pair & SlotMap::kGlue) != 0) continue;  // empty, or written when its cluster is reached
        if (at.startsCluster(pair)) {
            cluster = uint32_t(slot);
            clustersFirst = next;
            if (pair != 0) slots[at.glue[pair]] = ShortRecord::glue(cluster / map.lineSlots, next);
            ownLeavesFrom(pair);
        }
        const Node* nodes = &bvh.nodes[2 * size_t(pair) + 2];
        const InsetGrid grid(frame, boxes[pair], bounds, ShortRecord::kBits);
        ShortRecord record;
        grid.setPlanes(record, nodes[0].bounds, nodes[1].bounds);
        for (uint32_t child = 0; child < 2; ++child) {
            if (nodes[child].isLeaf()) {
                record.setReference(child, firstLeaf + firstOf[2 * size_t(pair) + 2 + child] - clustersFirst);
            } else {
                const uint32_t below = pairBelow(nodes[child]);
                record.setReference(child, at.named(below) - cluster);
                boxes[below] = grid.child(record, child);
            }
        }
        slots[slot] = record;
    }
    if (bvh.nodes[0].isLeaf()) own(bvh.nodes[0]);
    return {bounds,
            map.pointerBits,
            map.lineSlots,
            std::move(slots).share(),
            markLastEntries(leafSizes, primitives.size()),
            std::move(primitives)};
}

Bvh QuantizedShortForm::decode() const {
    const InsetFrame frame(bounds_);
    std::vector<uint32_t> pairOf(slots_.size(), SlotMap::kEmpty);  // of a record's slot
    uint32_t pairs = 0;
    for (size_t slot = 0; slot < slots_.size(); ++slot)
        if (!slots_[slot].isGlue()) pairOf[slot] = pairs++;

    Buffer<Node> nodes(2 * size_t(pairs) + 2);
    nodes[0] = {bounds_, 2, 0};
    if (pairs == 0) nodes[0] = {bounds_, 0, uint32_t(primitives_.size())};
    nodes[1] = {};
    struct Reached {
        InsetBox box;
        uint32_t firstSlot, firstEntry;
    };
    std::vector<Reached> reached(pairs);  // of a pair's parent
    if (pairs > 0) reached[0] = {};
    std::vector<uint32_t> words = std::move(pairOf);
    for (size_t slot = 0; slot < slots_.size(); ++slot) {
        const ShortRecord& record = slots_[slot];
        if (record.isGlue()) continue;
        const uint32_t pair = words[slot];
        const Reached& from = reached[pair];
        const InsetGrid grid(frame, from.box, bounds_, ShortRecord::kBits);
        for (uint32_t child = 0; child < 2; ++child) {
            const InsetBox box = grid.child(record, child);
            const uint32_t reference = record.reference(child);
            Node& node = nodes[2 * size_t(pair) + 2 + child];
            node.bounds = frame.floats(box);
            if (reference >= firstLeaf_) {
                node.first = firstEntryOf(from.firstEntry, reference);
                node.primitiveCount = countFrom(node.first);
                continue;
            }
            Reached next{box, from.firstSlot, from.firstEntry};
            uint32_t target = from.firstSlot + reference;
            if (slots_[target].isGlue()) {
                next.firstSlot = slots_[target].line() << lineShift_;
                next.firstEntry = slots_[target].firstEntry();
                words[target] = words[next.firstSlot] | SlotMap::kGlue;
                target = next.firstSlot;
            }
            node.first = 2 * words[target] + 2;
            node.primitiveCount = 0;
            reached[words[target]] = next;
        }
    }
    return {std::move(nodes).share(), primitives_, SlotMap{pointerBits_, 1u << lineShift_, std::move(words)}};
}

}  // namespace bvhio
