// The table of builders, which make a canonical BVH from triangles.
#pragma once

#include <span>

#include "core/choice.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The options that only some builders use.
enum BuildUses : uint32_t {
    kUsesBins = 1,
    kUsesSplitBudget = 2,
};

struct BuildOptions {
    SahCosts costs;
    uint32_t bins = 0;  // per axis, for binned builders; 0 = the builder's default
    uint32_t maxLeafSize = 4;
    float splitBudget = 0.3f;      // for builders that split triangles: most extra references per triangle
    Progress* progress = nullptr;  // counts the triangles that are in their leaves
};

/// A builder returns a tree that keeps every invariant of Bvh. The tree's bytes depend only on the scene and
/// the options, and not on the number of threads, the compiler or the processor.
using Builder = Choice<Method<Bvh(const Scene&, const BuildOptions&)>>;

/// Returns all builders, the default first.
std::span<const Builder> builders();

}  // namespace bvhio
