#include "tree/cluster_cuts.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace bvhio {
namespace {

constexpr uint32_t kNoPair = ClusterPair::kNone;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The cost of a slot, in fetches of a record that is fetched as often as the mean. At 1, using 1 percent
/// more memory is worth saving 1 percent of the fetches.
constexpr float kSlotCost = 1;

/// A tree knapsack. For each pair p and each s its table holds the least cost of the cuts below p if p's
/// subtree takes s units of its cluster, minus the cost of the best cluster that starts at p. A record takes
/// one unit, or more if entries are scarcer than slots.
class Knapsack {
  public:
    Knapsack(std::vector<ClusterPair>& pairs, const ClusterLimits& limits, bool countEntries)
        : pairs_(pairs), limits_(limits), countEntries_(countEntries), tables_(pairs.size()) {
        double sum = 0;
        for (const ClusterPair& pair : pairs_) sum += pair.weight;
        scale_ = sum > 0 ? double(pairs_.size()) / sum : 0;
        for (size_t p = pairs_.size(); p-- > 0;) fillTable(uint32_t(p));
        cutDown();
    }

  private:
    struct Table {
        size_t offset = 0;
        uint32_t size = 0;  // s is less than this
        uint32_t best = 0;  // s of the best cluster that starts here
        float cut = 0;      // the cost of a cut here
    };

    uint32_t unitsOf(const ClusterPair& pair) const {
        if (!countEntries_) return 1;
        return std::max(1u, (pair.entries * limits_.slots + limits_.entries - 1) / limits_.entries);
    }
    float costOf(uint32_t pair, uint32_t units) const { return costs_[tables_[pair].offset + units]; }
    /// Returns the cost with the choice to cut at the pair, which takes one unit, for the glue.
    float shareOf(uint32_t pair, uint32_t units) const {
        const float cost = costOf(pair, units);
        return units == 1 ? std::min(cost, tables_[pair].cut) : cost;
    }
    float costOfPadding(uint32_t units) const {
        return kSlotCost * float((limits_.lineSlots - units % limits_.lineSlots) % limits_.lineSlots);
    }

    void fillTable(uint32_t p) {
        // The most units that the subtree can take.
        const ClusterPair& pair = pairs_[p];
        const uint32_t own = unitsOf(pair);
        uint32_t most = own;
        for (const uint32_t child : pair.children)
            if (child != kNoPair) most += std::max(2u, tables_[child].size) - 1;
        Table& table = tables_[p];
        table.offset = costs_.size();
        table.size = std::min(most, limits_.slots) + 1;
        costs_.resize(table.offset + table.size, kInfinity);
        float* costs = costs_.data() + table.offset;

        // Combine each cost of the left child with each cost of the right one.
        const auto sharesOf = [&](uint32_t child, std::vector<float>& shares) {
            shares.assign(1, 0);
            if (child == kNoPair) return;
            shares.resize(tables_[child].size);
            shares[0] = kInfinity;
            for (uint32_t s = 1; s < shares.size(); ++s) shares[s] = shareOf(child, s);
        };
        sharesOf(pair.children[0], left_);
        sharesOf(pair.children[1], right_);
        if (left_.size() > right_.size()) std::swap(left_, right_);
        for (uint32_t i = 0; i < left_.size() && own + i < table.size; ++i) {
            const float a = left_[i];
            if (a == kInfinity) continue;
            const float* b = right_.data();
            float* out = costs + own + i;
            const auto end = uint32_t(std::min<size_t>(right_.size(), table.size - own - i));
            for (uint32_t j = 0; j < end; ++j) {
                const float sum = a + b[j];
                out[j] = sum < out[j] ? sum : out[j];
            }
        }

        // The best cluster that starts here; costs are relative to it.
        float least = kInfinity;
        for (uint32_t s = 1; s < table.size; ++s)
            if (const float cost = costs[s] + costOfPadding(s); cost < least) {
                least = cost;
                table.best = s;
            }
        for (uint32_t s = 1; s < table.size; ++s) costs[s] -= least;
        table.cut = float(pair.weight * scale_) + kSlotCost;
    }

    /// Finds the cuts that give the least cost, from the root down.
    void cutDown() {
        struct Share {
            uint32_t pair, units;
        };
        std::vector<Share> waiting{{0, tables_[0].best}};
        while (!waiting.empty()) {
            const Share share = waiting.back();
            waiting.pop_back();
            const ClusterPair& pair = pairs_[share.pair];
            const uint32_t rest = share.units - unitsOf(pair);
            const auto [left, right] = pair.children;
            uint32_t toLeft = 0;
            if (left != kNoPair && right == kNoPair) toLeft = rest;
            if (left != kNoPair && right != kNoPair) {
                float least = kInfinity;
                for (uint32_t i = 1; i < std::min(tables_[left].size, rest); ++i) {
                    if (rest - i >= tables_[right].size) continue;
                    const float sum = shareOf(left, i) + shareOf(right, rest - i);
                    if (sum < least) {
                        least = sum;
                        toLeft = i;
                    }
                }
            }
            for (const auto& [child, units] : {Share{left, toLeft}, Share{right, rest - toLeft}}) {
                if (child == kNoPair) continue;
                pairs_[child].isCut = units == 1 && tables_[child].cut < costOf(child, 1);
                waiting.push_back({child, pairs_[child].isCut ? tables_[child].best : units});
            }
        }
    }

    std::vector<ClusterPair>& pairs_;
    const ClusterLimits& limits_;
    bool countEntries_;
    std::vector<Table> tables_;
    std::vector<float> costs_;
    std::vector<float> left_, right_;
    double scale_ = 0;
};

/// Returns whether a cluster has too many entries.
bool exceedsEntries(const std::vector<ClusterPair>& pairs, uint32_t limit) {
    std::vector<uint32_t> entries(pairs.size());
    for (size_t p = pairs.size(); p-- > 0;) {
        entries[p] += pairs[p].entries;
        for (const uint32_t child : pairs[p].children)
            if (child != kNoPair && !pairs[child].isCut) entries[p] += entries[child];
        if (entries[p] > limit) return true;
    }
    return false;
}

}  // namespace

void cutAtLeastCost(std::vector<ClusterPair>& pairs, const ClusterLimits& limits) {
    // If each leaf has one entry, a cluster has at most one more entry than records, so only slots are
    // limited.
    ClusterLimits ofSlots = limits;
    ofSlots.slots = std::min(limits.slots, limits.entries - 1);
    Knapsack(pairs, ofSlots, false);
    if (exceedsEntries(pairs, limits.entries)) Knapsack(pairs, limits, true);
}

void cutFromAbove(std::vector<ClusterPair>& pairs, const ClusterLimits& limits) {
    const auto lighter = [&](uint32_t a, uint32_t b) {
        return pairs[a].weight != pairs[b].weight ? pairs[a].weight < pairs[b].weight : a > b;
    };
    std::vector<uint32_t> roots{0};
    while (!roots.empty()) {
        std::priority_queue<uint32_t, std::vector<uint32_t>, decltype(lighter)> border(lighter);
        border.push(roots.back());
        roots.pop_back();
        uint32_t size = 0, entries = 0;
        while (!border.empty()) {
            const ClusterPair& next = pairs[border.top()];
            if (size > 0 &&
                (size + border.size() + 2 > limits.slots || entries + next.entries > limits.entries))
                break;
            border.pop();
            ++size;
            entries += next.entries;
            for (const uint32_t child : next.children)
                if (child != kNoPair) border.push(child);
        }
        for (; !border.empty(); border.pop()) {
            pairs[border.top()].isCut = true;
            roots.push_back(border.top());
        }
    }
}

}  // namespace bvhio
