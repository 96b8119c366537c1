// The table of restructurers: they change which nodes a tree has, to lower its cost.
#pragma once

#include <vector>

#include "core/choice.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// Most leaves of a treelet.
inline constexpr uint32_t kMaxTreeletSize = 30;

/// The options that a restructurer may have a use for.
enum RestructureUses : uint32_t {
    kUsesIterations = 1,
    kUsesTreelets = 2,  // treeletSize and gamma
    kUsesLeaves = 4,    // collapse and maxLeafSize
};

struct RestructureOptions {
    SahCosts costs;
    uint32_t treeletSize = 0;  // leaves of a treelet, for methods that have treelets; 0 = the method's own
    uint32_t iterations = 0;   // 0 = the method's own
    uint32_t gamma = 0;        // references below a node from which it roots treelets; 0 = the treelet size
    bool collapse = true;      // leaves are opened first, and formed again where that is cheaper
    uint32_t maxLeafSize = 0;  // of leaves that form; 0 = that of the given tree, and at least 4
    bool recordCosts = false;  // find the cost after each iteration, which takes time of its own
    Progress* progress = nullptr;
};

/// What one pass over the tree did.
struct RestructureIteration {
    double sahCost = 0;    // after it, leaves formed; 0 unless recordCosts
    double seconds = 0;    // since the last, without finding costs
    uint64_t changes = 0;  // treelets rebuilt, or subtrees moved
};

struct Restructured {
    Bvh bvh;
    std::vector<RestructureIteration> iterations;
    double bytesPerNode = 0;      // the memory that the method works in, per node of the opened tree
    double recordingSeconds = 0;  // what recordCosts took
};

/// A restructurer returns a tree over the same triangles that keeps every invariant of Bvh and never costs
/// more, whose bytes depend on the tree and the options alone: not on the number of threads, the compiler or
/// the processor. Throws Error{usage} for options out of its range.
using Restructurer = Choice<Method<Restructured(const Scene&, const Bvh&, const RestructureOptions&)>>;

/// All restructurers, the default first.
std::span<const Restructurer> restructurers();

}  // namespace bvhio
