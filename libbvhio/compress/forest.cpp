#include "compress/forest.h"

#include <algorithm>

#include "core/buffer.h"

namespace bvhio {

std::optional<SeparateTrees> separateTrees(const Forest& forest, std::span<const uint32_t> primitives) {
    SeparateTrees result;
    size_t slot = 0;
    uint64_t entry = 0;
    for (const Node& root : forest.roots) {
        // Children come after their parents, so a tree is complete once there are as many pairs as inner
        // nodes.
        const size_t firstSlot = slot;
        size_t pairs = root.isLeaf() ? 0 : 1;
        uint64_t entries = root.primitiveCount;
        for (; slot < firstSlot + 2 * pairs; ++slot) {
            if (slot >= forest.nodes.size()) return {};
            const Node& node = forest.nodes[slot];
            entries += node.primitiveCount;
            pairs += !node.isLeaf();
        }
        if (entry + entries > primitives.size()) return {};
        Buffer<Node> nodes(2 + 2 * pairs);
        const auto moved = [&](Node node) {
            node.first -= node.isLeaf() ? uint32_t(entry) : uint32_t(firstSlot - 2);
            return node;
        };
        nodes[0] = moved(root);
        nodes[1] = {};
        for (size_t i = 0; i < 2 * pairs; ++i) nodes[2 + i] = moved(forest.nodes[firstSlot + i]);
        const auto own = primitives.subspan(size_t(entry), size_t(entries));
        result.trees.push_back({std::move(nodes).share(), std::vector<uint32_t>(own.begin(), own.end())});
        result.firstSlots.push_back(uint32_t(firstSlot));
        entry += entries;
    }
    if (slot != forest.nodes.size() || entry != primitives.size()) return {};
    return result;
}

GatheredTrees gatherTrees(std::span<const Bvh> trees) {
    size_t slots = 0, entries = 0;
    for (const Bvh& tree : trees) {
        slots += tree.nodes.size() - 2;
        entries += tree.primitives.size();
    }
    Buffer<Node> roots(trees.size()), nodes(slots);
    Buffer<uint32_t> primitives(entries);
    size_t slot = 0, entry = 0;
    for (size_t i = 0; i < trees.size(); ++i) {
        const auto moved = [&](Node node) {
            node.first += node.isLeaf() ? uint32_t(entry) : uint32_t(slot - 2);
            return node;
        };
        const Bvh& tree = trees[i];
        roots[i] = moved(tree.nodes[0]);
        for (size_t k = 2; k < tree.nodes.size(); ++k) nodes[slot + k - 2] = moved(tree.nodes[k]);
        std::copy(tree.primitives.begin(), tree.primitives.end(), primitives.data() + entry);
        slot += tree.nodes.size() - 2;
        entry += tree.primitives.size();
    }
    return {{std::move(roots).share(), std::move(nodes).share()}, std::move(primitives).share()};
}

}  // namespace bvhio
