// Two-level clustering. The pairs of a tree are divided into address clusters, within which pointers are
// short. The records of each address cluster are divided into cache clusters, which fill a line each.
//
// G. Liktor, K. Vaidyanathan, "Bandwidth-Efficient BVH Layout for Incremental Hardware Traversal", HPG 2016.
// In the paper an address cluster grows from its root, always by the largest record at its border, until it
// is full. Each pair left at the border becomes the root of another cluster, however little is below it.
// Cache clusters grow the same way, and those that end up short share lines.
//
// Departures (ClusterMethod::cheapest): a tree knapsack finds the cuts with the least total cost of fetched
// glue and used slots (tree/cluster_cuts.h). Another one finds the lines that a walk changes least often
// (tree/cluster_lines.h). The room that small parts leave in lines is filled with other parts. In a cluster
// too full for lines that end short, it is filled with the first items of a larger part.
#pragma once

#include <span>
#include <string_view>

#include "tree/bvh.h"

namespace bvhio {

enum class ClusterMethod { cheapest, paper };

struct ClusterOptions {
    uint32_t pointerBits = 8;  // 6 to 10
    uint32_t lineSlots = 8;    // a power of two up to 64
    ClusterMethod method{};
};

/// Divides a tree into clusters. `weights` is how often each pair is fetched, by half the index of its left
/// node, and at most its parent's; without it areas count. The order of nodes in memory does not matter.
SlotMap makeClusters(const Bvh& bvh, const ClusterOptions& options, std::span<const double> weights = {});

}  // namespace bvhio
