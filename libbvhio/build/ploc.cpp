// PLOC (Meister and Bittner 2018, "Parallel locally-ordered clustering for bounding volume hierarchy
// construction"; with refinements of Benthin et al. 2022, "PLOC++"). Clusters, at first one per triangle, are
// in Morton order. In each round every cluster searches the clusters within a radius in the order for the one
// with which its common box is smallest. Clusters that find each other are joined. Departures:
//
// - Chains in which each cluster finds the one before it have few mutual pairs. The next round then joins
//   neighbours in the order, so that the number of rounds is at most logarithmic.
// - Greedy joining is a little worse than top-down splits on smooth surfaces, and better on parts of mixed
//   sizes. So when the clusters are down to an eighth of the triangles, both kinds of tree are built over
//   them, and the cheaper one is kept.
// - Each join decides at once whether the subtree becomes a leaf (merged_tree).

#include "build/ploc.h"

#include <algorithm>
#include <vector>

#include "build/binned.h"
#include "build/merged_tree.h"
#include "build/morton.h"
#include "build/ploc_search.h"
#include "core/parallel.h"
#include "tree/depth.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/ploc.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Makes the clusters, of one triangle each, at places [begin, end) of the order.
void makeClusters(const Scene& scene, const MortonOrder& order, uint32_t begin, uint32_t end,
                  Reference* clusters) {
    constexpr uint32_t kAhead = 32;
    const TriangleBoxes boxes(scene, order.scale);
    for (uint32_t i = begin; i < end; ++i) {
        hwy::Prefetch(&scene.triangles[order.triangles[std::min(i + 2 * kAhead, end - 1)]]);
        boxes.prefetch(scene.triangles[order.triangles[std::min(i + kAhead, end - 1)]]);
        boxes(scene.triangles[order.triangles[i]]).store(reinterpret_cast<float*>(clusters + i));
        clusters[i].primitive = MergedTree::leafKey(i);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(makeClusters);

class PlocBuild {
  public:
    PlocBuild(const Scene& scene, const BuildOptions& options)
        : scene_(scene),
          options_(options),
          order_(mortonOrder(scene)),
          count_(uint32_t(scene.triangles.size())),
          tree_(scene, order_,
                {options.costs.traversal, options.costs.intersection, std::max(options.maxLeafSize, 1u)}),
          clusters_(count_),
          joined_(count_),
          nearest_(count_ + size_t(1)) {}

    Bvh build() && {
        const uint32_t triangles = count_;
        Progress* const progress = options_.progress;
        if (progress) progress->start(triangles);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            HWY_DYNAMIC_DISPATCH(makeClusters)
            (scene_, order_, uint32_t(begin), uint32_t(end), clusters_.data());
        });
        joinUntil(std::max(triangles / kUpperShare, 1u));
        if (count_ > 1) joinUpper();
        if (progress) progress->add(triangles - progress->done);
        Bvh bvh = tree_.finish(clusters_[0]);
        if (order_.scale != 1) bvh.nodes = refitted(scene_, bvh);
        return bvh;
    }

  private:
    static constexpr size_t kGrain = 1 << 12;
    static constexpr uint32_t kUpperShare = 8;
    static constexpr uint32_t kAhead = 16;  // how far ahead clusters are prefetched

    /// Joins clusters in rounds until at most `count` are left.
    void joinUntil(uint32_t count) {
        while (count_ > count) {
            const uint32_t before = count_;
            findNearestOfAll();
            joinNearest();
            if (options_.progress) options_.progress->add(before - count_);
            if (before - count_ < before / 32) {
                std::fill_n(nearest_.data(), count_, uint8_t(0));  // i and i ^ 1
                joinNearest();
            }
        }
    }

    void findNearestOfAll() {
        parallelChunks(count_, kSearchGrain, [&](size_t begin, size_t end) {
            findNearest(clusters_.data(), count_, uint32_t(begin), uint32_t(end), nearest_.data());
        });
    }

    /// Joins clusters that are each other's `nearest_`. The joined cluster takes the place of the first one.
    void joinNearest() {
        static constexpr PartnerOffsets kOffsets;
        nearest_[count_] = kPartners;  // not a partner's number

        // Count the clusters that stay and those that are joined, chunk by chunk.
        struct Chunk {
            uint32_t kept = 0, joined = 0;
        };
        std::vector<Chunk> chunks((count_ + kGrain - 1) / kGrain);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            Chunk chunk;
            for (auto i = uint32_t(begin); i < end; ++i) {
                const int offset = kOffsets(i, nearest_[i]);
                const bool isJoined = nearest_[i + uint32_t(offset)] == nearest_[i];
                chunk.kept += !(isJoined && offset < 0);
                chunk.joined += isJoined && offset > 0;
            }
            chunks[begin / kGrain] = chunk;
        });

        // Turn the counts into places.
        Chunk sum{0, pairCount_};
        for (Chunk& chunk : chunks) {
            const Chunk own = std::exchange(chunk, sum);
            sum.kept += own.kept;
            sum.joined += own.joined;
        }

        // Copy the clusters that stay, and then write the joined ones over the first of each pair. This
        // avoids a branch that cannot be predicted.
        tree_.startRound(pairCount_);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            auto [to, pair] = chunks[begin / kGrain];
            struct Joined {
                uint32_t first, second, to;
            };
            Joined joined[kGrain];
            uint32_t joinedCount = 0;
            for (auto i = uint32_t(begin); i < end; ++i) {
                const int offset = kOffsets(i, nearest_[i]);
                const bool isJoined = nearest_[i + uint32_t(offset)] == nearest_[i];
                joined[joinedCount] = {i, i + uint32_t(offset), to};
                joinedCount += isJoined && offset > 0;
                const bool stays = !(isJoined && offset < 0);
                if (stays) joined_[to] = clusters_[i];
                to += stays;
            }
            for (uint32_t k = 0; k < joinedCount; ++k) {
                const Joined& ahead = joined[std::min(k + kAhead, joinedCount - 1)];
                tree_.prefetch(clusters_[ahead.first]);
                tree_.prefetch(clusters_[ahead.second]);
                const auto [first, second, at] = joined[k];
                joined_[at] = tree_.join(pair++, clusters_[first], clusters_[second]);
            }
        });
        std::swap(clusters_, joined_);
        count_ = sum.kept;
        pairCount_ = sum.joined;
    }

    /// Joins the remaining clusters, or splits them from the root down if that is cheaper.
    void joinUpper() {
        // The bounds and the cost of the remaining clusters.
        const uint32_t remaining = count_, firstPair = pairCount_;
        Buffer<Reference> lower(remaining), references(remaining);
        struct Sum {
            Box bounds = Box::empty();
            float cost = 0;
        };
        std::vector<Sum> chunks((remaining + kGrain - 1) / kGrain);
        parallelChunks(remaining, kGrain, [&](size_t begin, size_t end) {
            Sum& sum = chunks[begin / kGrain];
            for (size_t i = begin; i < end; ++i) {
                const Reference& cluster = lower[i] = references[i] = clusters_[i];
                references[i].primitive = uint32_t(i);
                sum.bounds.extend({{cluster.negatedMin[0], cluster.negatedMin[1], cluster.negatedMin[2], 0},
                                   {cluster.max[0], cluster.max[1], cluster.max[2], 0}});
                sum.cost += tree_.cost(cluster);
            }
        });
        Sum all;
        for (const Sum& sum : chunks) {
            all.bounds.extend(sum.bounds);
            all.cost += sum.cost;
        }

        // The cost of the tree by splits; then join the clusters, and compare.
        const Bvh split = buildBinnedOver(std::move(references), all.bounds, options_.costs);
        double splitCost = all.cost;
        for (size_t i = 0; i < split.nodes.size(); ++i)
            if (i != 1 && !split.nodes[i].isLeaf())
                splitCost += options_.costs.traversal * halfArea(split.nodes[i].bounds);
        joinUntil(1);
        if (!(splitCost < tree_.cost(clusters_[0]))) return;
        pairCount_ = firstPair;
        joinAs(split, lower);
    }

    /// Joins clusters like a given tree over them, level by level from the deepest up.
    void joinAs(const Bvh& split, const Buffer<Reference>& lower) {
        const size_t slots = split.nodes.size();
        std::vector<std::vector<uint32_t>> levels;  // inner nodes
        const std::vector<uint32_t> depths = depthsOfPairs(split);
        for (uint32_t i = 0; i < slots; ++i) {
            const Node& node = split.nodes[i];
            if (i == 1 || node.isLeaf()) continue;
            if (levels.size() <= depths[i / 2]) levels.resize(depths[i / 2] + size_t(1));
            levels[depths[i / 2]].push_back(i);
        }
        Buffer<Reference> above(slots);
        const auto clusterOf = [&](uint32_t node) -> const Reference& {
            return split.nodes[node].isLeaf() ? lower[split.primitives[split.nodes[node].first]]
                                              : above[node];
        };
        for (; !levels.empty(); levels.pop_back()) {
            const std::vector<uint32_t>& level = levels.back();
            tree_.startRound(pairCount_);
            parallelChunks(level.size(), kGrain, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) {
                    const Node& node = split.nodes[level[i]];
                    above[level[i]] =
                        tree_.join(pairCount_ + uint32_t(i), clusterOf(node.left()), clusterOf(node.right()));
                }
            });
            pairCount_ += uint32_t(level.size());
        }
        clusters_[0] = above[0];
    }

    const Scene& scene_;
    const BuildOptions& options_;
    MortonOrder order_;
    uint32_t count_;
    uint32_t pairCount_ = 0;
    MergedTree tree_;
    Buffer<Reference> clusters_, joined_;
    Buffer<uint8_t> nearest_;  // each cluster's partner, by number
};

}  // namespace

Bvh buildPloc(const Scene& scene, const BuildOptions& options) {
    return PlocBuild(scene, options).build();
}

}  // namespace bvhio
#endif
