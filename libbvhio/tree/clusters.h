// Two-level clustering: divides the pairs of a tree into address clusters, in which short pointers reach
// everything, and the records of each into cache clusters, which fill a line.
//
// G. Liktor, K. Vaidyanathan, "Bandwidth-Efficient BVH Layout for Incremental Hardware Traversal", HPG 2016.
// An address cluster grows there from its root by the largest record at its border until it is full, and
// each pair left at the border becomes a cluster of its own, however little is below it; cache clusters grow
// alike, and those that end up short share lines.
//
// Departures (ClusterMethod::cheapest): a tree knapsack finds the cuts that cost the least in glue fetched
// and slots spent together (tree/cluster_cuts.h), and another one the lines with the fewest expected changes
// from one to another (tree/cluster_lines.h); what small parts leave of lines is filled with others, or, in
// a cluster too full for lines that end short, with the first of a larger part.
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

/// `weights` says how often each pair is fetched, by half the index of its left node, a parent's at least as
/// often as its children's; without it areas do. The order of nodes in memory does not matter.
SlotMap makeClusters(const Bvh& bvh, const ClusterOptions& options, std::span<const double> weights = {});

}  // namespace bvhio
