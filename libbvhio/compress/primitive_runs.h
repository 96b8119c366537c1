// The primitives of many trees, tree by tree, from which BLASes in the mvh form are made.
#pragma once

#include <span>
#include <vector>

#include "compress/forest.h"
#include "compress/nibble_blases.h"
#include "scene/scene.h"

namespace bvhio {

/// Primitives tree by tree, each with the box that its leaf must hold. For a part of a split triangle, this
/// is the part of the triangle's box in its leaf.
struct Runs {
    std::vector<PrimitiveRange> ranges;  // of each tree
    std::vector<uint32_t> primitives;
    std::vector<Aabb> boxes;
    std::vector<uint32_t>
        ordered;  // where a tree's run starts that has the shape of an MVH: its length, else 0
};

/// Gathers each tree's primitives into one run. A tree that has the shape of an MVH, such as a decoded one,
/// keeps its order.
Runs gatherRuns(const Scene& scene, const Forest& forest, std::span<const uint32_t> primitives,
                const NibbleRuns& shape);

/// Returns the top level with leaves that own the runs, instead of the trees over them.
Bvh withRuns(const Bvh& top, const Runs& runs);

}  // namespace bvhio
