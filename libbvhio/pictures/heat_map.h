// A picture of the cost of each pixel's rays.
#pragma once

#include <span>

#include "pictures/image.h"
#include "rays/ray_sets.h"

namespace bvhio {

/// Returns the mean cost per ray of each pixel, row by row, from the costs of a set's rays (box and triangle
/// tests, NC + TC). Pixels without a ray get 0. Not for `random`, whose rays do not belong to pixels.
std::vector<float> costPerPixel(const RaySet& set, std::span<const uint32_t> costs);

/// Returns the cost that a heat map shows as white: the least round number that 99.5% of the pixels with any
/// cost do not exceed.
uint32_t whiteCost(std::span<const float> costs);

/// Draws costs from black (0) over red to white (`white` and more), in perceptually equal steps of lightness,
/// with a legend below the picture. `white` = 0 uses whiteCost; use the same number to compare two pictures.
/// The image is as wide as the resolution, and higher by legendHeight.
Image heatMap(std::span<const float> costs, Resolution resolution, uint32_t white = 0);

/// Returns the number of rows that the legend adds to a picture of this width.
uint32_t legendHeight(uint32_t width);

/// Returns the colour of a cost as a fraction of `white`, from 0 to 1.
Rgb heatColor(double share);

}  // namespace bvhio
