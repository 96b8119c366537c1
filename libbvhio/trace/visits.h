// Counts how often rays fetch each pair of siblings, for layouts.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "trace/trace.h"

namespace bvhio {

/// Traces the rays through the tree like the aabb form, and returns how many rays fetch each pair, by half
/// the index of its left node. The first element, for the root and the unused slot, counts the rays that do
/// not miss by definition. A pair's count is at most that of the pair that holds its parent.
std::vector<uint32_t> countVisits(const Scene& scene, const Bvh& bvh, std::span<const Ray> rays,
                                  QueryKind query);

}  // namespace bvhio
