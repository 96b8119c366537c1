// A sensible camera for a scene that came without one.
#pragma once

#include "rays/ray_sets.h"

namespace bvhio {

/// Finds a camera for pictures of the given aspect (width / height), with +y up, from the scene and the
/// answers of `closestHits` alone. An object is seen from the front (+z), the right and above, so that it
/// fills the picture. A scene that surrounds its own middle with surfaces facing inwards is an interior:
/// there the camera stands at a person's height and looks where the view is deepest.
Camera findCamera(const Scene& scene, double aspect, const ClosestHits& closestHits);

}  // namespace bvhio
