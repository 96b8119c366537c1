#include "relayout/clusters.h"

#include <algorithm>
#include <bit>

#include "tree/clusters.h"

namespace bvhio {
namespace {

constexpr uint32_t kRecordBytes = 8;

LayoutResult layout(const Bvh& bvh, const LayoutOptions& given, ClusterMethod method) {
    ClusterOptions options;
    options.pointerBits = std::clamp(given.pointerBits, SlotMap::kMinPointerBits, SlotMap::kMaxPointerBits);
    options.lineSlots = std::bit_floor(std::clamp(given.lineSize / kRecordBytes, 1u, SlotMap::kMaxLineSlots));
    options.method = method;
    LayoutResult result{{}, makeClusters(bvh, options, given.weights)};
    // Renumber the pairs in the slots by their places in the layout.
    std::vector<uint32_t> words(result.slots.words.begin(), result.slots.words.end());
    std::vector<uint32_t> place(bvh.nodes.size() / 2 - 1);
    for (uint32_t& word : words) {
        if ((word & SlotMap::kGlue) != 0) continue;  // empty, too
        place[word] = uint32_t(result.order.size());
        result.order.push_back(2 * word + 2);
        word = place[word];
    }
    for (uint32_t& word : words)
        if ((word & SlotMap::kGlue) != 0 && word != SlotMap::kEmpty)
            word = place[word & ~SlotMap::kGlue] | SlotMap::kGlue;
    result.slots.words = std::move(words);
    return result;
}

}  // namespace

LayoutResult layoutClusters(const Bvh& bvh, const LayoutOptions& options) {
    return layout(bvh, options, ClusterMethod::cheapest);
}

LayoutResult layoutClustersAsPaper(const Bvh& bvh, const LayoutOptions& options) {
    return layout(bvh, options, ClusterMethod::paper);
}

Bvh applyLayout(const Bvh& bvh, const LayoutResult& layout) {
    Bvh ordered = applyNodeOrder(bvh, layout.order);
    ordered.slots = layout.slots;
    return ordered;
}

}  // namespace bvhio
