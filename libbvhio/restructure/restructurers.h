// The table of restructurers, which change the topology of a tree to lower its cost.
#pragma once

#include <vector>

#include "core/choice.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The most leaves of a treelet.
inline constexpr uint32_t kMaxTreeletSize = 30;

/// The options that only some restructurers use.
enum RestructureUses : uint32_t {
    kUsesIterations = 1,
    kUsesTreelets = 2,  // treeletSize and gamma
    kUsesLeaves = 4,    // collapse and maxLeafSize
};

struct RestructureOptions {
    SahCosts costs;
    uint32_t treeletSize = 0;  // leaves of a treelet, for methods with treelets; 0 = the method's default
    uint32_t iterations = 0;   // 0 = the method's default
    uint32_t gamma = 0;        // fewest references below the root of a treelet; 0 = the treelet size
    bool collapse = true;      // open leaves first, and form them again where that is cheaper
    uint32_t maxLeafSize = 0;  // of leaves that form; 0 = the given tree's, but at least 4
    bool recordCosts = false;  // compute the cost after each iteration, which takes extra time
    Progress* progress = nullptr;
};

/// The result of one pass over the tree.
struct RestructureIteration {
    double sahCost = 0;    // after the pass, with leaves formed; 0 unless recordCosts
    double seconds = 0;    // since the last pass, without computing costs
    uint64_t changes = 0;  // rebuilt treelets, or moved subtrees
};

struct Restructured {
    Bvh bvh;
    std::vector<RestructureIteration> iterations;
    double bytesPerNode = 0;      // the method's working memory, per node of the opened tree
    double recordingSeconds = 0;  // the time of recordCosts
};

/// A restructurer returns a tree over the same triangles that keeps every invariant of Bvh and never costs
/// more. The tree's bytes depend only on the given tree and the options, and not on the number of threads,
/// the compiler or the processor. Throws Error{usage} if an option is out of range.
using Restructurer = Choice<Method<Restructured(const Scene&, const Bvh&, const RestructureOptions&)>>;

/// Returns all restructurers, the default first.
std::span<const Restructurer> restructurers();

}  // namespace bvhio
