// A picture of what each pixel's rays cost.
#pragma once

#include <span>

#include "pictures/image.h"
#include "rays/ray_sets.h"

namespace bvhio {

/// The mean cost per ray of each pixel, row by row, from the costs of a set's rays (box and triangle tests,
/// NC + TC). Pixels without a ray get 0. Not for `random`, whose rays belong to no pixel.
std::vector<float> costPerPixel(const RaySet& set, std::span<const uint32_t> costs);

/// The cost that a heat map shows as white: the least round number that 99.5% of the pixels that have any
/// cost stay below or at.
uint32_t whiteCost(std::span<const float> costs);

/// Costs from black (0) over red to white (`white` and more), each step equally lighter to the eye, and below
/// the picture a legend that says so. `white` = 0 takes whiteCost; give the same number to compare two
/// pictures. The image is as wide as the resolution and higher by legendHeight.
Image heatMap(std::span<const float> costs, Resolution resolution, uint32_t white = 0);

/// Rows that the legend adds to a picture of this width.
uint32_t legendHeight(uint32_t width);

/// The colour of a share of white, 0 to 1.
Rgb heatColor(double share);

}  // namespace bvhio
