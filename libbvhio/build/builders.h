// The table of builders: from triangles to a canonical BVH.
#pragma once

#include <span>

#include "core/choice.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "tree/bvh.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The options that not every builder has a use for.
enum BuildUses : uint32_t {
    kUsesBins = 1,
    kUsesSplitBudget = 2,
};

struct BuildOptions {
    SahCosts costs;
    uint32_t bins = 0;  // per axis, for binned builders; 0 = the builder's own default
    uint32_t maxLeafSize = 4;
    float splitBudget = 0.3f;      // for builders that split triangles: most extra references, per triangle
    Progress* progress = nullptr;  // where to count the triangles that are in place, for who watches
};

/// A builder returns a tree that keeps every invariant of Bvh, whose bytes depend on the scene and the
/// options alone: not on the number of threads, the compiler or the processor.
using Builder = Choice<Method<Bvh(const Scene&, const BuildOptions&)>>;

/// All builders, the default first.
std::span<const Builder> builders();

}  // namespace bvhio
