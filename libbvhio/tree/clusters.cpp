#include "tree/clusters.h"

#include <algorithm>
#include <array>

#include "tree/cluster_cuts.h"
#include "tree/cluster_lines.h"

namespace bvhio {
namespace {

constexpr uint32_t kNoParent = TreeItem::kNone;

/// Returns the pairs depth first, left before right, so that ties do not depend on the order in memory.
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
            // Larger leaves are divided when they are stored.
            pair.entries += std::min(node.primitiveCount, SlotMap::kMaxLeafSize);
            if (!node.isLeaf()) waiting.push_back({above.left() + side, number, side});
        }
    }
    return pairs;
}

/// The records of a cluster, and its glue records, which lead to the clusters below.
struct Cluster {
    std::vector<TreeItem> items;
    std::vector<uint32_t> words;  // the contents of the items' slots, with numbers of pairs

    Cluster(const std::vector<ClusterPair>& pairs, uint32_t root) {
        const auto add = [&](uint32_t pair, uint32_t glue) {
            items.push_back({pairs[pair].weight});
            words.push_back(pair | glue);
        };
        add(root, 0);
        for (size_t i = 0; i < items.size(); ++i) {
            if ((words[i] & SlotMap::kGlue) != 0) continue;
            const ClusterPair& pair = pairs[words[i]];
            for (size_t side = 0; side < 2; ++side) {
                const uint32_t child = pair.children[side];
                if (child == kNoParent) continue;
                items[i].children[side] = uint32_t(items.size());
                add(child, pairs[child].isCut ? SlotMap::kGlue : 0);
            }
        }
    }
};

}  // namespace

SlotMap makeClusters(const Bvh& bvh, const ClusterOptions& options, std::span<const double> weights) {
    SlotMap map{options.pointerBits, options.lineSlots, {}};
    if (bvh.nodes.size() == 2) return map;

    // Cut the tree into clusters.
    std::vector<ClusterPair> pairs = pairsOf(bvh, weights);
    const bool asPaper = options.method == ClusterMethod::paper;
    (asPaper ? cutFromAbove : cutAtLeastCost)(
        pairs, {1u << options.pointerBits, SlotMap::maxEntries(options.pointerBits), options.lineSlots});

    // Write the clusters one after another, each line by line.
    std::vector<uint32_t> words;
    words.reserve(pairs.size() + pairs.size() / 8);
    const auto padToLine = [&] {
        const size_t lines = (words.size() + options.lineSlots - 1) / options.lineSlots;
        words.resize(lines * options.lineSlots, SlotMap::kEmpty);
    };
    std::vector<uint32_t> roots{0};  // of the clusters still to write; the next is the last
    while (!roots.empty()) {
        const Cluster cluster(pairs, roots.back());
        roots.pop_back();
        const uint32_t maxSlots = 1u << options.pointerBits;
        const ClusterLines lines = asPaper ? growLines(cluster.items, options.lineSlots)
                                           : packLines(cluster.items, options.lineSlots, maxSlots);
        // Short lines end in padding, as long as everything stays in reach of the cluster's pointers.
        size_t spare = maxSlots - cluster.items.size();
        for (const std::vector<uint32_t>& line : lines) {
            for (const uint32_t item : line) words.push_back(cluster.words[item]);
            const size_t padding = (options.lineSlots - words.size() % options.lineSlots) % options.lineSlots;
            if (padding > spare) continue;
            spare -= padding;
            padToLine();
        }
        padToLine();

        // The clusters below come next, the heaviest first.
        const auto behind = std::ptrdiff_t(roots.size());
        for (const uint32_t word : cluster.words)
            if ((word & SlotMap::kGlue) != 0) roots.push_back(word & ~SlotMap::kGlue);
        std::sort(roots.begin() + behind, roots.end(), [&](uint32_t a, uint32_t b) {
            return pairs[a].weight != pairs[b].weight ? pairs[a].weight < pairs[b].weight : a > b;
        });
    }

    // Replace the numbers of pairs by their indices in memory.
    while (words.back() == SlotMap::kEmpty) words.pop_back();
    for (uint32_t& word : words)
        if (word != SlotMap::kEmpty) word = pairs[word & ~SlotMap::kGlue].index | (word & SlotMap::kGlue);
    map.words = std::move(words);
    return map;
}

}  // namespace bvhio
