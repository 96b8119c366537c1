// Searches for the place in the tree where a subtree would cost least.
#pragma once

#include <span>

#include "restructure/tree_editor.h"

namespace bvhio {

/// The place next to a node `beside`: a new parent would get this node and the moved subtree as children.
/// `gain` is the decrease of the sum of the inner nodes' areas, in coordinates scaled by extentScale; 0 if
/// the subtree should stay.
struct Place {
    float gain = 0;
    uint32_t beside = 0;
};

/// Finds the best place for each of some nodes; the root may not be one of them. The search is exact except
/// for rounding. But if thousands of places could be the best, it finds the best of those that it meets
/// first.
void findPlaces(const TreeEditor& tree, float scale, std::span<const uint32_t> nodes, Place* places);

}  // namespace bvhio
