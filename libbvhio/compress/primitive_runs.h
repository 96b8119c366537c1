// The primitives of many trees, tree by tree: what BLASes in the mvh form are made over.
#pragma once

#include <span>
#include <vector>

#include "compress/forest.h"
#include "compress/mvh_blases.h"
#include "scene/scene.h"

namespace bvhio {

/// Primitives tree by tree, each with a box that must hold it there: of a triangle that was split, what is of
/// it in its leaf.
struct Runs {
    std::vector<PrimitiveRange> ranges;  // of each tree
    std::vector<uint32_t> primitives;
    std::vector<Aabb> boxes;
    std::vector<uint32_t>
        ordered;  // where a tree's run starts that has the shape of an MVH: its length, else 0
};

/// Gathers each tree's primitives into one run. A tree that has the shape of an MVH, as one that was decoded,
/// keeps its order.
Runs gatherRuns(const Scene& scene, const Forest& forest, std::span<const uint32_t> primitives,
                const MvhRuns& shape);

/// The top level whose leaves own the runs, not the trees over them.
Bvh withRuns(const Bvh& top, const Runs& runs);

}  // namespace bvhio
