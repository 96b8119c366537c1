// Where to cut a tree into clusters.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bvhio {

/// A pair of siblings, as clustering sees it. Pairs are numbered, with parents before their children.
struct ClusterPair {
    static constexpr uint32_t kNone = 0xFFFFFFFF;

    uint32_t index = 0;                              // in memory: nodes 2 index + 2 and 2 index + 3
    std::array<uint32_t, 2> children{kNone, kNone};  // numbers of the pairs below
    uint32_t entries = 0;                            // of the leaf order, owned by the pair's leaves
    bool isCut = false;                              // whether the pair starts a cluster
    double weight = 0;                               // how often the pair is fetched
};

/// The limits of a cluster.
struct ClusterLimits {
    uint32_t slots, entries;
    uint32_t lineSlots;  // clusters start at multiples of this
};

/// Finds the cuts with the least sum of two costs: the fetches of glue, as a share of all fetched records;
/// and the slots of glue and of the padding after clusters, as a share of all records. A tree knapsack over
/// the number of slots that a subtree takes in its parent's cluster. Time O(n slots), and 4 bytes for each
/// slot of each subtree.
void cutAtLeastCost(std::vector<ClusterPair>& pairs, const ClusterLimits& limits);

/// Cuts as in the paper: clusters grow from their roots by the heaviest pair at the border. In the paper a
/// cluster may become one slot too large; here it stops before.
void cutFromAbove(std::vector<ClusterPair>& pairs, const ClusterLimits& limits);

}  // namespace bvhio
