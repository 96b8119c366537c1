// A dynamic program over the tree, from the leaves up: for each pair and each size j, the least cost of its
// subtree where the pair's cluster has j pairs from it on down. A child joins the cluster with some of its
// own subtree, or starts another cluster and costs its weight.

#include "relayout/connected_clusters.h"

#include <algorithm>
#include <limits>

namespace bvhio {
namespace {

constexpr uint32_t kNone = PairTree::kNone;

class ClusterCosts {
  public:
    ClusterCosts(const PairTree& tree, uint32_t maxSize, const std::vector<uint32_t>& within)
        : tree_(tree), within_(within), maxSize_(maxSize), first_(tree.size()) {
        size_t total = 0;
        for (uint32_t pair = 0; pair < tree.size(); ++pair) {
            first_[pair] = total;
            total += sizes(pair);
        }
        costs_.assign(total, std::numeric_limits<double>::infinity());
        left_.resize(total);
        apart_.resize(tree.size());
        bestSize_.resize(tree.size());
        for (auto pair = uint32_t(tree.size()); pair-- > 0;) solve(pair);
    }

    /// How large the cluster is that starts at a pair.
    uint32_t bestSize(uint32_t pair) const { return bestSize_[pair]; }
    /// Of `size` pairs from this one on down, how many are below its left node; the others but this one are
    /// below its right node.
    uint32_t sizeOnTheLeft(uint32_t pair, uint32_t size) const { return left_[first_[pair] + size - 1]; }

  private:
    uint32_t sizes(uint32_t pair) const { return pair == kNone ? 0 : std::min(maxSize_, tree_[pair].size); }
    double cost(uint32_t pair, uint32_t size) const {
        if (pair == kNone) return 0;
        return size == 0 ? apart_[pair] : costs_[first_[pair] + size - 1];
    }

    /// How many pairs at most a child may add to its parent's cluster.
    uint32_t mayJoin(uint32_t parent, uint32_t child) const {
        if (child == kNone || (!within_.empty() && within_[child] != within_[parent])) return 0;
        return std::min(sizes(child), maxSize_ - 1);
    }

    void solve(uint32_t pair) {
        const auto [left, right] = tree_[pair].children;
        double* costs = &costs_[first_[pair]];
        const uint32_t mostLeft = mayJoin(pair, left), mostRight = mayJoin(pair, right);
        for (uint32_t i = 0; i <= mostLeft; ++i)
            for (uint32_t j = 0; j <= mostRight && i + j < maxSize_; ++j) {
                const double sum = cost(left, i) + cost(right, j);
                if (!(sum < costs[i + j])) continue;
                costs[i + j] = sum;
                left_[first_[pair] + i + j] = uint16_t(i);
            }
        // Of equal costs the largest cluster, which leaves the fewest lines.
        uint32_t best = 1;
        for (uint32_t size = 2; size <= sizes(pair); ++size)
            if (costs[size - 1] <= costs[best - 1]) best = size;
        bestSize_[pair] = uint16_t(best);
        apart_[pair] = costs[best - 1] + tree_[pair].weight;
    }

    const PairTree& tree_;
    const std::vector<uint32_t>& within_;
    uint32_t maxSize_;
    std::vector<size_t> first_;   // of each pair, in costs_ and left_: one element for each size from 1 on
    std::vector<double> costs_;   // without the pair's own weight
    std::vector<uint16_t> left_;  // pairs below the left node
    std::vector<double> apart_;   // the cost where the pair starts a cluster, its weight included
    std::vector<uint16_t> bestSize_;
};

}  // namespace

std::vector<uint32_t> connectedClusters(const PairTree& tree, uint32_t maxSize,
                                        const std::vector<uint32_t>& within) {
    const ClusterCosts costs(tree, maxSize, within);
    std::vector<uint32_t> top(tree.size());
    std::vector<uint16_t> joined(tree.size(),
                                 0);  // pairs of the cluster from this one on down; 0: it starts one
    for (uint32_t pair = 0; pair < tree.size(); ++pair) {
        const bool starts = joined[pair] == 0;
        top[pair] = starts ? pair : top[tree[pair].parent];
        const uint32_t size = starts ? costs.bestSize(pair) : joined[pair];
        const uint32_t onTheLeft = costs.sizeOnTheLeft(pair, size);
        const auto [left, right] = tree[pair].children;
        if (left != kNone) joined[left] = uint16_t(onTheLeft);
        if (right != kNone) joined[right] = uint16_t(size - 1 - onTheLeft);
    }
    return top;
}

}  // namespace bvhio
