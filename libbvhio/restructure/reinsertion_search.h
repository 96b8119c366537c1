// Where in the tree a subtree would cost least.
#pragma once

#include <span>

#include "restructure/tree_editor.h"

namespace bvhio {

/// The place beside a node, whose parent and the moved subtree's would be a new one; and by how much the sum
/// of the inner nodes' areas would fall, scaled as extentScale says. No gain: the subtree stays.
struct Place {
    float gain = 0;
    uint32_t beside = 0;
};

/// The best place for each of some nodes, none of them the root. The search is exact but for rounding, unless
/// a node has thousands of places that could be the best: then it is the best of those seen first.
void findPlaces(const TreeEditor& tree, float scale, std::span<const uint32_t> nodes, Place* places);

}  // namespace bvhio
