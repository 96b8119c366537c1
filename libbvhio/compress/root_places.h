// The places of the roots of many trees: data that a tree takes from the level above, and does not store.
#pragma once

#include <algorithm>
#include <vector>

#include "compress/form_concept.h"
#include "compress/inset_box.h"

namespace bvhio {

/// The arrays are indexed by tree.
struct RootPlaces {
    std::vector<InsetFrame> frames;    // frames for rays: one for each tree, or one for all
    std::vector<Aabb> bounds;          // of the root
    std::vector<InsetBox> insets;      // the bounds in the tree's frame
    std::vector<PrimitiveRange> runs;  // the primitives below the root, if they are not stored elsewhere

    const InsetFrame& frame(size_t tree) const { return frames[frames.size() == 1 ? 0 : tree]; }

    /// Returns the box below the root that insets describe. Insets of a box with full-precision planes may be
    /// slightly too small, so the result is limited to the root's box.
    Aabb floats(size_t tree, const InsetBox& box) const {
        const Aabb& root = bounds[tree];
        Aabb result = frame(tree).floats(box);
        for (int axis = 0; axis < 3; ++axis) {
            result.min[axis] = std::max(result.min[axis], root.min[axis]);
            result.max[axis] = std::min(result.max[axis], root.max[axis]);
        }
        return result;
    }
};

}  // namespace bvhio
