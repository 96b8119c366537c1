// Finds a reasonable camera for a scene without one.
#pragma once

#include "rays/ray_sets.h"

namespace bvhio {

/// Finds a camera for pictures of the given aspect ratio (width / height), with +y up, from only the scene
/// and the answers of `closestHits`. An object is seen from the front (+z), the right and above, and fills
/// the picture. A scene whose middle is surrounded by surfaces facing inwards is an interior: there the
/// camera is at a person's height and looks in the direction of the deepest view.
Camera findCamera(const Scene& scene, double aspect, const ClosestHits& closestHits);

}  // namespace bvhio
