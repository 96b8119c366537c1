#include "scene/scene.h"

#include <algorithm>

namespace bvhio {

Scene::PrimitiveId Scene::primitiveId(uint32_t triangle) const {
    // The last geometry that starts at or before the triangle; empty geometries share a start, and the last
    // of them owns it.
    const auto after = std::upper_bound(geometries.begin(), geometries.end(), triangle,
                                        [](uint32_t t, const Geometry& g) { return t < g.firstTriangle; });
    const auto geometry = uint32_t(after - geometries.begin()) - 1;
    const uint32_t primitive =
        sourcePrimitives.empty() ? triangle - geometries[geometry].firstTriangle : sourcePrimitives[triangle];
    return {geometry, primitive};
}

}  // namespace bvhio
