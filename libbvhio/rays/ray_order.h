// The order in which rays are traced, which determines the accesses to memory. Hits are always reported in
// the order in which rays were given.
#pragma once

#include <span>
#include <vector>

#include "core/choice.h"
#include "core/ray.h"

namespace bvhio {

using RayOrderChoice = Choice<std::vector<uint32_t> (*)(std::span<const Ray>, uint64_t seed)>;

/// Returns all orders, the default first. Each gives a permutation: element i is the ray to trace i-th.
///
/// - given: the given order.
/// - morton: by the octant of the direction, then along a Morton curve through origin and direction together
///   (10 bits for each of the six numbers, as in Aila and Karras 2010), so that neighbours start close to
///   each other and go in similar directions.
/// - shuffled: uniformly at random, by seed; the worst case for caches.
std::span<const RayOrderChoice> rayOrders();

}  // namespace bvhio
