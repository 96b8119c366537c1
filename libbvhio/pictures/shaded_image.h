// A picture of a scene, to see what rays see.
#pragma once

#include "pictures/image.h"
#include "rays/ray_sets.h"

namespace bvhio {

/// Shades what a camera sees: flat normals, a lamp near the viewer, ambient light that nearby surfaces block
/// (kAoReach of the diagonal), a colour per geometry. Each pixel averages 2 x 2 points; rows are traced in
/// bands, so that memory stays small. Throws Error{usage} for a camera that looks nowhere.
Image shadedImage(const Scene& scene, const Camera& camera, Resolution resolution,
                  const ClosestHits& closestHits);

}  // namespace bvhio
