// Where to cut a tree into clusters.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bvhio {

/// What clustering needs of a pair of siblings. Pairs are numbered with parents before their children.
struct ClusterPair {
    static constexpr uint32_t kNone = 0xFFFFFFFF;

    uint32_t index = 0;                              // in memory: the nodes 2 index + 2 and 2 index + 3
    std::array<uint32_t, 2> children{kNone, kNone};  // numbers of the pairs below
    uint32_t entries = 0;                            // of the leaf order, that its leaves own
    bool isCut = false;                              // it starts a cluster
    double weight = 0;                               // how often it is fetched
};

/// Limits of a cluster.
struct ClusterLimits {
    uint32_t slots, entries;
    uint32_t lineSlots;  // clusters start at multiples
};

/// Cuts with the least sum of two costs: how often glue is fetched, as a share of all records fetched; and
/// the slots of glue and of padding behind clusters, as a share of all records. A tree knapsack over the
/// slots that a subtree takes in the cluster of its parent; O(n slots), 4 bytes for each slot of each
/// subtree.
void cutAtLeastCost(std::vector<ClusterPair>& pairs, const ClusterLimits& limits);

/// Cuts as the paper draws them: clusters grow from their roots by the heaviest pair at the border. There
/// they may come out one slot too large; here they stop before.
void cutFromAbove(std::vector<ClusterPair>& pairs, const ClusterLimits& limits);

}  // namespace bvhio
