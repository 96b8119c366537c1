// Full-sweep SAH: every plane between two centroids on every axis is tried (MacDonald and Booth 1990,
// "Heuristics for ray tracing using space subdivision"; as a sweep over sorted centroids: Wald, Boulos and
// Shirley 2007, "Ray tracing deformable scenes using dynamic bounding volume hierarchies"). References are
// sorted once for each axis, and splits keep all three orders, so the time is n log n. Small ranges and
// leaves are handled as in the default builder (top_down).

#include "build/sweep.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "build/top_down.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

constexpr size_t kGrain = 1 << 15;  // references that a task marks at a time

/// The first `leftCount` references in the order of `axis` go left.
struct Plane {
    float cost = kInfinity;
    uint32_t axis = 0, leftCount = 0;
};

/// Returns the half areas of four boxes, lane by lane, from their extents.
HWY_INLINE FourV halfAreas(const float (*extents)[4]) {
    FourV x, y, z, unused;
    hn::LoadInterleaved4(Four(), extents[0], x, y, z, unused);
    return hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
}

/// Returns the plane of least SAH cost over references in order; of equals, the first. `areas` has space for
/// count + 4 floats.
Plane bestPlane(const Reference* references, uint32_t count, float* areas) {
    const Four d;
    alignas(16) float extents[4][4];
    const auto add = [&](BoxV& box, uint32_t i, uint32_t lane) HWY_ATTR {
        if (i >= count) return hn::Store(hn::Set(d, kInfinity), d, extents[lane]);
        box = unite(box, BoxV::load(reinterpret_cast<const float*>(references + i)));
        hn::Store(hn::Add(box.low(), box.high()), d, extents[lane]);
    };
    // Sweep from the right: areas[i] is the half area of the box around references i and up.
    BoxV right = BoxV::empty();
    const uint32_t groups = (count + 3) / 4;
    for (uint32_t group = groups; group-- > 0;) {
        for (uint32_t lane = 4; lane-- > 0;) add(right, 4 * group + lane, lane);
        hn::StoreU(halfAreas(extents), d, areas + 4 * group);
    }
    areas[4 * groups] = kInfinity;

    // Sweep from the left. The plane after reference i has i + 1 references on the left. After the last
    // reference the right side's area is infinite, and after that both areas are, so the cost is infinite or
    // not a number.
    const hn::RebindToSigned<Four> di;
    BoxV left = BoxV::empty();
    const FourV total = hn::Set(d, float(count)), firstCounts = hn::Iota(d, 1);
    FourV bestCosts = hn::Set(d, kInfinity);
    auto bestGroups = hn::Zero(di);
    for (uint32_t group = 0; group < groups; ++group) {
        for (uint32_t lane = 0; lane < 4; ++lane) add(left, 4 * group + lane, lane);
        const FourV counts = hn::Add(hn::Set(d, float(4 * group)), firstCounts);
        const FourV costs = hn::Add(hn::Mul(halfAreas(extents), counts),
                                    hn::Mul(hn::LoadU(d, areas + 4 * group + 1), hn::Sub(total, counts)));
        const auto better = hn::Lt(costs, bestCosts);
        bestCosts = hn::IfThenElse(better, costs, bestCosts);
        bestGroups = hn::IfThenElse(hn::RebindMask(di, better), hn::Set(di, int32_t(group)), bestGroups);
    }

    // The best of the four lanes.
    alignas(16) float laneCosts[4];
    alignas(16) int32_t laneGroups[4];
    hn::Store(bestCosts, d, laneCosts);
    hn::Store(bestGroups, di, laneGroups);
    Plane best;
    for (uint32_t lane = 0; lane < 4; ++lane) {
        const uint32_t leftCount = 4 * uint32_t(laneGroups[lane]) + lane + 1;
        if (laneCosts[lane] < best.cost || (laneCosts[lane] == best.cost && leftCount < best.leftCount))
            best = {laneCosts[lane], 0, leftCount};
    }
    return best;
}

/// Marks the references of a run, and returns the run's bounds.
Box markAndBound(const Reference* references, size_t count, uint8_t mark, uint8_t* marks) {
    BoxV bounds = BoxV::empty();
    for (size_t i = 0; i < count; ++i) {
        bounds = unite(bounds, BoxV::load(reinterpret_cast<const float*>(references + i)));
        marks[references[i].primitive] = mark;
    }
    Box box;
    bounds.store(box.negatedMin);
    return box;
}

/// Copies references to the side that their marks name (1: right), in order.
void partition(const Reference* references, uint32_t count, const uint8_t* marks, Reference* left,
               Reference* right) {
    for (uint32_t i = 0; i < count; ++i) {
        const bool isRight = marks[references[i].primitive];
        Reference* const to = isRight ? right : left;
        BoxV::load(reinterpret_cast<const float*>(references + i)).store(reinterpret_cast<float*>(to));
        right += isRight;
        left += !isRight;
    }
}

class SweepSplitter {
  public:
    static constexpr uint32_t kOrders = 3;

    explicit SweepSplitter(size_t triangles) : marks_(triangles) {}

    void makeOrders(const ReferenceArrays& references, const Range& range) {
        TaskGroup group;
        for (uint32_t axis = 0; axis < kOrders; ++axis)
            group.run([&, axis] {
                sortAlong(int(axis), references.at(range), range.count, references.left(range, axis));
            });
        group.wait();
    }

    bool split(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        // The SAH cannot compare planes if boxes have no area (all on a line or a point), or if centroids
        // coincide.
        if (!(range.bounds.halfArea() > std::numeric_limits<float>::min())) return false;
        Plane planes[kOrders];
        const auto sweep = [&](uint32_t axis) {
            const Reference* order = references.at(range, axis);
            if (order[0].centroid(int(axis)) == order[range.count - 1].centroid(int(axis))) return;
            Buffer<float> areas(size_t(range.count) + 8);
            planes[axis] = bestPlane(order, range.count, areas.data());
            planes[axis].axis = axis;
        };
        forEachOrder(parallel, sweep);
        Plane best;
        for (const Plane& plane : planes)
            if (plane.cost < best.cost) best = plane;
        if (!(best.cost < kInfinity)) return false;
        divide(references, range, best, left, right, parallel);
        return true;
    }

    /// Halves a range along the axis on which its centroids spread most.
    void halve(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        Plane plane;
        plane.leftCount = range.count / 2;
        float widest = 0;
        for (uint32_t axis = 0; axis < kOrders; ++axis) {
            const Reference* order = references.at(range, axis);
            const float extent = order[range.count - 1].centroid(int(axis)) - order[0].centroid(int(axis));
            if (extent > widest) {
                widest = extent;
                plane.axis = axis;
            }
        }
        divide(references, range, plane, left, right, parallel);
    }

  private:
    /// Writes references in the order of their centroids along an axis, ties by primitive, by a radix sort.
    static void sortAlong(int axis, const Reference* references, uint32_t count, Reference* sorted) {
        constexpr uint32_t kDigit = 11, kPasses = 3, kValues = 1 << kDigit;
        struct Key {
            uint32_t value, index;
        };
        Buffer<Key> buffers[2] = {Buffer<Key>(count), Buffer<Key>(count)};
        std::vector<uint32_t> places(kPasses * kValues);
        for (uint32_t i = 0; i < count; ++i) {
            // These unsigned integers have the order of the floats.
            const auto bits = std::bit_cast<uint32_t>(references[i].centroid(axis) + 0.0f);
            const uint32_t value = bits ^ (bits >> 31 ? ~0u : 1u << 31);
            buffers[0][i] = {value, i};
            for (uint32_t pass = 0; pass < kPasses; ++pass)
                ++places[pass * kValues + (value >> (pass * kDigit) & (kValues - 1))];
        }
        for (uint32_t pass = 0; pass < kPasses; ++pass) {
            uint32_t* const next = places.data() + pass * kValues;
            uint32_t sum = 0;
            for (uint32_t value = 0; value < kValues; ++value) sum += std::exchange(next[value], sum);
            const Key* from = buffers[pass % 2].data();
            Key* const to = buffers[1 - pass % 2].data();
            for (uint32_t i = 0; i < count; ++i)
                to[next[from[i].value >> (pass * kDigit) & (kValues - 1)]++] = from[i];
        }
        const Key* keys = buffers[kPasses % 2].data();
        for (uint32_t i = 0; i < count; ++i) sorted[i] = references[keys[i].index];
    }

    template <class Work>
    static void forEachOrder(bool parallel, const Work& work) {
        if (!parallel) {
            for (uint32_t order = 0; order < kOrders; ++order) work(order);
            return;
        }
        TaskGroup group;
        for (uint32_t order = 1; order < kOrders; ++order) group.run([&work, order] { work(order); });
        work(0);
        group.wait();
    }

    /// Moves the references of both sides, in all orders.
    void divide(const ReferenceArrays& references, const Range& range, const Plane& plane, Range& left,
                Range& right, bool parallel) const {
        left.count = plane.leftCount;
        right.count = range.count - plane.leftCount;
        const Reference* order = references.at(range, plane.axis);
        left.bounds = mark(order, left.count, 0, parallel);
        right.bounds = mark(order + left.count, right.count, 1, parallel);
        forEachOrder(parallel, [&](uint32_t axis) {
            if (axis == plane.axis)
                std::memcpy(static_cast<void*>(references.left(range, axis)), order,
                            range.count * sizeof(Reference));
            else
                partition(references.at(range, axis), range.count, marks_.data(),
                          references.left(range, axis), references.right(range, right.count, axis));
        });
    }

    Box mark(const Reference* run, uint32_t count, uint8_t value, bool parallel) const {
        if (!parallel) return markAndBound(run, count, value, marks_.data());
        std::vector<Box> chunks((count + kGrain - 1) / kGrain);
        parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
            chunks[begin / kGrain] = markAndBound(run + begin, end - begin, value, marks_.data());
        });
        Box bounds = Box::empty();
        for (const Box& chunk : chunks) bounds.extend(chunk);
        return bounds;
    }

    mutable Buffer<uint8_t> marks_;  // by primitive; ranges that are divided at once share no primitives
};

Bvh build(const Scene& scene, const BuildOptions& options) {
    SweepSplitter splitter(scene.triangles.size());
    return TopDownBuild<SweepSplitter>(options, splitter).build(scene);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(build);

Bvh buildSweep(const Scene& scene, const BuildOptions& options) {
    return HWY_DYNAMIC_DISPATCH(build)(scene, options);
}

}  // namespace bvhio
#endif
