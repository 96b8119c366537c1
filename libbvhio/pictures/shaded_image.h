// A shaded picture of a scene, to see what rays hit.
#pragma once

#include "pictures/image.h"
#include "rays/ray_sets.h"

namespace bvhio {

/// Draws a scene with flat normals, a lamp near the viewer, ambient light that nearby surfaces block (within
/// kAoReach of the diagonal), and a colour for each geometry. Each pixel is the mean of 2 x 2 points. Rows
/// are traced in bands, so that little memory is needed. Throws Error{usage} for an invalid camera.
Image shadedImage(const Scene& scene, const Camera& camera, Resolution resolution,
                  const ClosestHits& closestHits);

}  // namespace bvhio
