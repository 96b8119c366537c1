#include "core/clusters.h"

#include <algorithm>
#include <array>

#include "core/cluster_cuts.h"
#include "core/cluster_lines.h"

namespace bvhio {
namespace {

constexpr uint32_t kNoParent = ClusterItem::kNone;

/// Depth first, left before right, so that ties do not depend on their order in memory.
std::vector<ClusterPair> pairsOf(const Bvh& bvh, std::span<const double> weights) {
    std::vector<ClusterPair> pairs;
    pairs.reserve(bvh.nodes.size() / 2 - 1);
    struct Waiting {
        uint32_t node, parent, side;
    };
    std::vector<Waiting> waiting{{0, kNoParent, 0}};  // inner nodes
    while (!waiting.empty()) {
        const Waiting next = waiting.back();
        waiting.pop_back();
        const Node& above = bvh.nodes[next.node];
        const auto number = uint32_t(pairs.size());
        if (next.parent != kNoParent) pairs[next.parent].children[next.side] = number;
        ClusterPair& pair = pairs.emplace_back();
        pair.index = above.left() / 2 - 1;
        pair.weight = weights.empty() ? halfArea(above.bounds) : weights[pair.index + 1];
        for (const uint32_t side : {1u, 0u}) {
            const Node& node = bvh.nodes[above.left() + side];
            // Larger leaves are divided before they are stored.
            pair.entries += std::min(node.primitiveCount, SlotMap::kMaxLeafSize);
            if (!node.isLeaf()) waiting.push_back({above.left() + side, number, side});
        }
    }
    return pairs;
}

/// The records of the cluster that starts at a pair, and glue for those that start below it.
void gather(const std::vector<ClusterPair>& pairs, uint32_t root, std::vector<ClusterItem>& items) {
    items.assign(1, {root, pairs[root].weight});
    for (size_t i = 0; i < items.size(); ++i) {
        if ((items[i].word & SlotMap::kGlue) != 0) continue;
        const ClusterPair& pair = pairs[items[i].word];
        for (size_t side = 0; side < 2; ++side) {
            const uint32_t child = pair.children[side];
            if (child == kNoParent) continue;
            items[i].children[side] = uint32_t(items.size());
            items.push_back({child | (pairs[child].isCut ? SlotMap::kGlue : 0), pairs[child].weight});
        }
    }
}

}  // namespace

SlotMap makeClusters(const Bvh& bvh, const ClusterOptions& options, std::span<const double> weights) {
    SlotMap map{options.pointerBits, options.lineSlots, {}};
    if (bvh.nodes.size() == 2) return map;
    std::vector<ClusterPair> pairs = pairsOf(bvh, weights);
    const bool asPaper = options.method == ClusterMethod::paper;
    (asPaper ? cutFromAbove : cutAtLeastCost)(
        pairs, {1u << options.pointerBits, SlotMap::maxEntries(options.pointerBits), options.lineSlots});

    std::vector<uint32_t> words;
    words.reserve(pairs.size() + pairs.size() / 8);
    const auto padToLine = [&] {
        const size_t lines = (words.size() + options.lineSlots - 1) / options.lineSlots;
        words.resize(lines * options.lineSlots, SlotMap::kEmpty);
    };
    std::vector<uint32_t> roots{0};  // of clusters to come, depth first, the heaviest child first
    std::vector<ClusterItem> items;
    while (!roots.empty()) {
        gather(pairs, roots.back(), items);
        roots.pop_back();
        const ClusterLines lines =
            asPaper ? growLines(items, options.lineSlots) : packLines(items, options.lineSlots);
        // Short lines end in padding, unless that would take the last ones out of reach.
        const bool isPadded = lines.size() * options.lineSlots <= 1u << options.pointerBits;
        for (const std::vector<uint32_t>& line : lines) {
            for (const uint32_t item : line) words.push_back(items[item].word);
            if (isPadded) padToLine();
        }
        padToLine();
        const auto behind = std::ptrdiff_t(roots.size());
        for (const ClusterItem& item : items)
            if ((item.word & SlotMap::kGlue) != 0) roots.push_back(item.word & ~SlotMap::kGlue);
        std::sort(roots.begin() + behind, roots.end(), [&](uint32_t a, uint32_t b) {
            return pairs[a].weight != pairs[b].weight ? pairs[a].weight < pairs[b].weight : a > b;
        });
    }
    while (words.back() == SlotMap::kEmpty) words.pop_back();
    for (uint32_t& word : words)
        if (word != SlotMap::kEmpty) word = pairs[word & ~SlotMap::kGlue].index | (word & SlotMap::kGlue);
    map.words = std::move(words);
    return map;
}

}  // namespace bvhio
