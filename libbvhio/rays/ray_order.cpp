// The Morton order follows Aila and Karras, "Architecture Considerations for Tracing Incoherent Rays" (HPG
// 2010), who sort by the interleaved bits of origin and direction. Departures: keys have 63 bits instead of
// 192, and start with the octant.
#include "rays/ray_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/aabb.h"
#include "core/parallel.h"
#include "core/random.h"

namespace bvhio {
namespace {

constexpr int kBits = 10;  // of each coordinate

std::vector<uint32_t> given(std::span<const Ray> rays, uint64_t) {
    std::vector<uint32_t> order(rays.size());
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

/// Moves bits 0 to 9 of x to bits 0, 6, 12 and so on.
uint64_t spread(uint64_t x) {
    uint64_t spread = 0;
    for (int bit = 0; bit < kBits; ++bit) spread |= ((x >> bit) & 1) << (6 * bit);
    return spread;
}

/// Converts x in [0, 1] to an integer of kBits bits; NaN gives 0.
uint64_t quantize(double x) {
    constexpr double top = (1 << kBits) - 1;
    return x > 0 ? uint64_t(std::min(x, 1.0) * top) : 0;
}

uint64_t mortonKey(const Ray& ray, const Aabb& origins) {
    uint64_t octant = 0, key = 0;
    const double l =
        std::sqrt(double(ray.direction.x) * ray.direction.x + double(ray.direction.y) * ray.direction.y +
                  double(ray.direction.z) * ray.direction.z);
    for (int axis = 0; axis < 3; ++axis) {
        const double size = double(origins.max[axis]) - origins.min[axis];
        // NaN if all origins are equal, which quantize turns into 0.
        const double at = (double(ray.origin[axis]) - origins.min[axis]) / size;
        octant = octant * 2 + std::signbit(ray.direction[axis]);
        key |= spread(quantize(at)) << (5 - axis);
        key |= spread(quantize(std::fabs(double(ray.direction[axis])) / l)) << (2 - axis);
    }
    return octant << (6 * kBits) | key;
}

std::vector<uint32_t> morton(std::span<const Ray> rays, uint64_t seed) {
    Aabb origins = Aabb::empty();
    for (const Ray& ray : rays)
        if (isFinite(ray.origin)) origins.extend(ray.origin);
    std::vector<uint64_t> keys(rays.size());
    parallelChunks(rays.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) keys[i] = mortonKey(rays[i], origins);
    });
    std::vector<uint32_t> order = given(rays, seed);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
    return order;
}

/// Shuffles by Fisher and Yates.
std::vector<uint32_t> shuffled(std::span<const Ray> rays, uint64_t seed) {
    std::vector<uint32_t> order = given(rays, seed);
    Random random(seed);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(uint32_t(i))]);
    return order;
}

constexpr RayOrderChoice kRayOrders[] = {
    {"given", "in the order of the set", given},
    {"morton", "along a Morton curve through origins and directions", morton},
    {"shuffled", "at random, the worst case for caches", shuffled},
};

}  // namespace

std::span<const RayOrderChoice> rayOrders() {
    return kRayOrders;
}

}  // namespace bvhio
