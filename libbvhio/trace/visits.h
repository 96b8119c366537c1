// How often rays fetch each pair of siblings: what layouts can be made from.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "trace/trace.h"

namespace bvhio {

/// Runs the queries through the tree, as the aabb form traces it, and counts by half the index of a pair's
/// left node how many of the rays fetch it. The first element, of the root and the unused slot, counts the
/// rays that are traced at all: that do not miss by definition. No pair's count is above that of the pair
/// which holds its parent.
std::vector<uint32_t> countVisits(const Scene& scene, const Bvh& bvh, std::span<const Ray> rays, Query query);

}  // namespace bvhio
