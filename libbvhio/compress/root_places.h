// Where the roots of many trees are put: what each takes over from above, as it does not store it.
#pragma once

#include <algorithm>
#include <vector>

#include "compress/form_concept.h"
#include "compress/inset_box.h"

namespace bvhio {

/// By tree.
struct RootPlaces {
    std::vector<InsetFrame> frames;    // what a ray's frame is made of: of each tree, or one that all share
    std::vector<Aabb> bounds;          // of the root
    std::vector<InsetBox> insets;      // the same in its frame
    std::vector<PrimitiveRange> runs;  // what is below the root, where nothing else tells

    const InsetFrame& frame(size_t tree) const { return frames[frames.size() == 1 ? 0 : tree]; }

    /// The box below the root that insets stand for. Insets of a box with full-precision planes may be a
    /// little too small: what lies in the root's box counts.
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
