#include "relayout/order_effect.h"

#include <numeric>

namespace bvhio {
namespace {

constexpr uint32_t kNoGlue = 0xFFFFFFFF;
constexpr uint32_t kSlotBytes = 8;

/// The place in memory of each pair's record, and of the glue that leads to it, by half the index of the
/// pair's left node before the layout, minus 1.
struct Places {
    std::vector<uint32_t> records, glue;

    explicit Places(size_t pairs) : records(pairs), glue(pairs, kNoGlue) {
        std::iota(records.begin(), records.end(), 0u);
    }
    Places(size_t pairs, const LayoutResult& layout) : Places(pairs) {
        const auto pairAt = [&](uint32_t place) { return layout.order[place] / 2 - 1; };
        for (uint32_t place = 0; place < pairs; ++place) records[pairAt(place)] = place;
        for (uint32_t slot = 0; slot < layout.slots.words.size(); ++slot) {
            const uint32_t word = layout.slots.words[slot];
            if (word == SlotMap::kEmpty) continue;
            const bool isGlue = (word & SlotMap::kGlue) != 0;
            (isGlue ? glue : records)[pairAt(word & ~SlotMap::kGlue)] = slot;
        }
    }
};

double expectedChanges(const Bvh& bvh, const PairWeights& weights, const Places& places, uint32_t recordBytes,
                       uint32_t blockBytes) {
    const double top = weights[bvh.nodes[0].left() / 2];
    if (!(top > 0)) return 0;
    const auto blockOf = [&](uint32_t place) { return uint64_t(place) * recordBytes / blockBytes; };
    double sum = 0;
    for (size_t i = 2; i < bvh.nodes.size(); ++i) {
        if (bvh.nodes[i].isLeaf()) continue;
        const uint32_t child = bvh.nodes[i].left() / 2 - 1;
        const uint64_t from = blockOf(places.records[i / 2 - 1]), to = blockOf(places.records[child]);
        const uint64_t between = places.glue[child] == kNoGlue ? from : blockOf(places.glue[child]);
        sum += weights[child + 1] * (int(from != between) + int(between != to));
    }
    return sum / top;
}

uint64_t blocks(uint64_t bytes, uint64_t blockBytes) {
    return (bytes + blockBytes - 1) / blockBytes;
}

}  // namespace

OrderEffect effectOf(const Bvh& before, const LayoutResult& layout, const LayoutOptions& options) {
    OrderEffect effect;
    effect.pairs = layout.order.size();
    effect.recordBytes = layout.slots.empty() ? options.recordBytes : kSlotBytes;
    if (effect.pairs == 0) return effect;
    for (size_t place = 0; place < layout.order.size(); ++place)
        effect.moved += layout.order[place] != 2 * place + 2;
    const uint64_t bytes =
        (layout.slots.empty() ? effect.pairs : layout.slots.words.size()) * effect.recordBytes;
    effect.lines = blocks(bytes, options.lineSize);
    effect.pages = blocks(bytes, OrderEffect::kPageBytes);

    const PairWeights weights = options.weights.empty() ? weightsByArea(before) : options.weights;
    const Places old(layout.order.size()), now(layout.order.size(), layout);
    for (const auto& [changes, block] :
         {std::pair{&effect.lineChanges, options.lineSize}, {&effect.pageChanges, OrderEffect::kPageBytes}}) {
        changes->before = expectedChanges(before, weights, old, effect.recordBytes, block);
        changes->after = expectedChanges(before, weights, now, effect.recordBytes, block);
    }
    return effect;
}

}  // namespace bvhio
