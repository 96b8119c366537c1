// The order in which rays are traced: what memory sees of a ray set. Hits are always reported in the order
// the rays were given.
#pragma once

#include <span>
#include <vector>

#include "core/choice.h"
#include "core/ray.h"

namespace bvhio {

using RayOrderChoice = Choice<std::vector<uint32_t> (*)(std::span<const Ray>, uint64_t seed)>;

/// All orders, the default first; each gives a permutation: element i is the ray to trace i-th.
/// - given: as they are.
/// - morton: by the octant of the direction, then along a Morton curve through origin and direction together
///   (10 bits for each of the six numbers, as in Aila and Karras 2010): neighbours start close to each other
///   and go the same way.
/// - shuffled: uniformly at random, by seed; the worst case for caches.
std::span<const RayOrderChoice> rayOrders();

}  // namespace bvhio
