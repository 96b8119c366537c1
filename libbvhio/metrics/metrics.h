// Counts of the costs of traversal, with the same definitions for every form.
//
// A query finds the closest hit or any hit of one ray. "Per ray" means the sum over all rays, divided by
// their number. All sums are sums of integers, so the numbers do not depend on the number of threads or the
// processor.
//
// NC       per ray  Boxes tested against the ray: 1 for the root, and 1 for each child of each
//                   inner node that the ray steps through.
// LC       per ray  Leaves entered, so that their triangles are tested.
// TC       per ray  Triangles tested: the triangle count of each leaf entered (also if an any-hit query ends
//                   inside the leaf, and if four are tested at once).
// AOC      per ray  Arithmetic operations of the box tests: subtractions and multiplications, plus
//                   comparisons, minima and maxima. A full box takes 12 + 12: 6 differences, 6 products; 6
//                   minima or maxima for near and far, 4 to merge the axes, 2 to compare with the ray's
//                   interval and the nearest hit. Both parts are also reported separately.
// BLB      per ray  Bytes read: the size of each fetched node record (aabb: 32 for the root, 64 for a pair of
//                   siblings), and 52 for each tested triangle: 4 of the primitive array, 12 of indices, 36 of
//                   vertices.
// LCV               The standard deviation over rays of LC: sqrt(E[LC^2] - E[LC]^2).
// records  per ray  Node records fetched. Other data that a form reads to find a leaf's triangles counts as
//                   a record.
// SOC      per ray  Stack operations: pushes and pops.
// SBL      per ray  Bytes moved by stack operations.
//
// Locality (LJC, CMC, WSS) is in metrics/locality.h. Sources of the names and of LCV: T. Aila, T. Karras, S.
// Laine, "On Quality Metrics of Bounding Volume Hierarchies", HPG 2013, and the metrics of the HeavyRT
// renderer, which counts 60 bytes per triangle in BLB.
#pragma once

#include <cmath>
#include <tuple>

#include "metrics/no_metrics.h"

namespace bvhio {

/// Bytes read to test one triangle: its entry in the primitive array, three indices, three vertices.
inline constexpr uint64_t kTriangleBytes = 4 + 12 + 36;

/// The counts of one ray, for pictures.
struct RayCounts {
    uint32_t boxTests = 0, leaves = 0, triangleTests = 0;
};

/// Sums over rays.
struct TraversalCounts {
    uint64_t rays = 0, hits = 0;
    uint64_t boxTests = 0, leaves = 0, triangleTests = 0, records = 0, recordBytes = 0;
    uint64_t boxArithmetic = 0, boxComparisons = 0, stackOperations = 0, stackBytes = 0;
    uint64_t leavesSquared = 0;  // the sum over rays of LC^2

    double perRay(uint64_t sum) const { return rays == 0 ? 0 : double(sum) / double(rays); }
    double nc() const { return perRay(boxTests); }
    double lc() const { return perRay(leaves); }
    double tc() const { return perRay(triangleTests); }
    double aoc() const { return perRay(boxArithmetic + boxComparisons); }
    double blb() const { return perRay(recordBytes + triangleTests * kTriangleBytes); }
    double soc() const { return perRay(stackOperations); }
    double sbl() const { return perRay(stackBytes); }
    double lcv() const {
        // In integers until the end: n * sum of squares - square of the sum cannot lose the difference of two
        // large numbers.
        const auto n = static_cast<unsigned __int128>(rays);
        const auto variance = n * leavesSquared - static_cast<unsigned __int128>(leaves) * leaves;
        return rays == 0 ? 0 : std::sqrt(double(variance)) / double(rays);
    }

    void add(const TraversalCounts& other) {
        rays += other.rays;
        hits += other.hits;
        boxTests += other.boxTests;
        leaves += other.leaves;
        triangleTests += other.triangleTests;
        records += other.records;
        recordBytes += other.recordBytes;
        boxArithmetic += other.boxArithmetic;
        boxComparisons += other.boxComparisons;
        stackOperations += other.stackOperations;
        stackBytes += other.stackBytes;
        leavesSquared += other.leavesSquared;
    }
    bool operator==(const TraversalCounts&) const = default;
};

/// The metrics policy that counts these costs. Call `finishRay` after each ray.
class CountMetrics : public NoMetrics {
  public:
    void recordFetched(size_t, size_t bytes) {
        ++sums_.records;
        sums_.recordBytes += bytes;
    }
    void boxesTested(uint32_t count, BoxTestCost cost) {
        ray_.boxTests += count;
        sums_.boxArithmetic += uint64_t(count) * cost.arithmetic;
        sums_.boxComparisons += uint64_t(count) * cost.comparisons;
    }
    void leafEntered(PrimitiveRange range) {
        ++ray_.leaves;
        ray_.triangleTests += range.count;
    }
    void pushed(size_t bytes) {
        ++sums_.stackOperations;
        sums_.stackBytes += bytes;
    }
    void popped(size_t bytes) { pushed(bytes); }

    RayCounts finishRay(bool hit) {
        const RayCounts ray = ray_;
        ++sums_.rays;
        sums_.hits += hit;
        sums_.boxTests += ray.boxTests;
        sums_.leaves += ray.leaves;
        sums_.triangleTests += ray.triangleTests;
        sums_.leavesSquared += uint64_t(ray.leaves) * ray.leaves;
        ray_ = {};
        return ray;
    }
    const TraversalCounts& sums() const { return sums_; }

  private:
    RayCounts ray_;
    TraversalCounts sums_;
};

/// Combines several policies.
template <class... Policies>
struct CombinedMetrics {
    std::tuple<Policies&...> policies;

    explicit CombinedMetrics(Policies&... each) : policies(each...) {}
    void recordFetched(size_t offset, size_t bytes) {
        std::apply([&](auto&... p) { (p.recordFetched(offset, bytes), ...); }, policies);
    }
    void boxesTested(uint32_t count, BoxTestCost cost) {
        std::apply([&](auto&... p) { (p.boxesTested(count, cost), ...); }, policies);
    }
    void leafEntered(PrimitiveRange range) {
        std::apply([&](auto&... p) { (p.leafEntered(range), ...); }, policies);
    }
    void pushed(size_t bytes) {
        std::apply([&](auto&... p) { (p.pushed(bytes), ...); }, policies);
    }
    void popped(size_t bytes) {
        std::apply([&](auto&... p) { (p.popped(bytes), ...); }, policies);
    }
};

/// The policy of the bottom of two levels, whose records come after those of the top level.
template <class Policy>
struct MetricsBehind {
    Policy& policy;
    size_t topBytes;

    BVHIO_INLINE void recordFetched(size_t offset, size_t bytes) {
        policy.recordFetched(topBytes + offset, bytes);
    }
    BVHIO_INLINE void boxesTested(uint32_t count, BoxTestCost cost) { policy.boxesTested(count, cost); }
    BVHIO_INLINE void leafEntered(PrimitiveRange range) { policy.leafEntered(range); }
    BVHIO_INLINE void pushed(size_t bytes) { policy.pushed(bytes); }
    BVHIO_INLINE void popped(size_t bytes) { policy.popped(bytes); }
};

}  // namespace bvhio
