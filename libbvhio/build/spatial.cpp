// SAH with spatial splits: M. Stich, H. Friedrich, A. Dietrich, "Spatial Splits in Bounding Volume
// Hierarchies", HPG 2009. If the sides of the best object split overlap, planes that cut triangles in two are
// tried too. A triangle that is cheaper whole on one side stays whole ("reference unsplitting"). Departures:
//
// - The whole tree has one budget of extra references, the spare room of the array, instead of the paper's
//   bound on overlaps. A split takes what it needs of its node's share. The rest is divided in proportion to
//   the sizes of the boxes on each side, since large boxes gain most from cuts, and what a subtree does not
//   use goes to its neighbour. So the tree depends only on the input.
// - Parts are bounded by clipping the triangle to the whole box of the part, not to one plane
//   (core/clip_triangle).
// - Unsplitting compares with the sides after all cuts, in the order of the references.
// - The rest is as in the default builder: object splits over bins, subtrees by tasks, exact solutions for
//   ranges of a few references, and leaves decided bottom-up (object_split_simd, small_tree, top_down).

#include "build/spatial.h"

#include "build/binned.h"
#include "build/top_down.h"
#include "core/clip_triangle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/spatial.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/object_split_simd.h"
#include "build/spatial_split_simd.h"

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Returns the least overlap of an object split's sides, relative to their parent's area, from which cuts are
/// tried. With less overlap few cuts gain anything, and even fewer with few references.
float minOverlap(uint32_t count) {
    return count < 256 ? 0.3f : 0.1f;
}

/// Returns the default number of slabs per axis: few for few references.
uint32_t defaultSlabs(uint32_t count) {
    return count >= 1u << 12 ? 32 : count >= 32 ? 16 : 8;
}

Box boxOf(const Reference& reference) {
    Box box;
    std::memcpy(&box, &reference, sizeof box);
    return box;
}

Box boxOf(const Aabb& b) {
    return {{0 - b.min.x, 0 - b.min.y, 0 - b.min.z, 0}, {b.max.x, b.max.y, b.max.z, 0}};
}

Box united(Box a, const Box& b) {
    a.extend(b);
    return a;
}

float overlapArea(const Box& a, const Box& b) {
    Box both;
    for (int axis = 0; axis < 3; ++axis) {
        both.negatedMin[axis] = std::min(a.negatedMin[axis], b.negatedMin[axis]);
        both.max[axis] = std::min(a.max[axis], b.max[axis]);
        if (!(both.extent(axis) >= 0)) return 0;
    }
    return both.halfArea();
}

/// Returns the demand of references for spare room: the sum of the extents of their boxes.
float demandOf(const Reference* references, uint32_t count) {
    const Four d;
    const FourV three = firstThree();
    FourV sums = hn::Zero(d);
    for (uint32_t i = 0; i < count; ++i) {
        const float* lanes = floats(references + i);
        sums = hn::Add(sums,
                       hn::Add(hn::And(three, hn::Load(d, lanes)), hn::And(three, hn::Load(d, lanes + 4))));
    }
    alignas(16) float lanes[4];
    hn::Store(sums, d, lanes);
    return lanes[0] + lanes[1] + lanes[2];
}

/// A reference that a plane cuts, and its parts on both sides. One part is empty if the reference stays
/// whole.
struct Crossing {
    Reference whole;
    Box parts[2];
    bool has(int side) const { return parts[side].negatedMin[0] != -kInfinity; }
};

class SpatialSplitter {
  public:
    /// `bins` is the number of bins per axis, of centroids and of space; 0 = by the number of references.
    SpatialSplitter(const Scene& scene, uint32_t bins) : scene_(scene), bins_(bins) {}

    bool split(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        ObjectSplit object;
        if (!findObjectSplit(references, range, bins_, parallel, object, left, right)) return false;
        if (!splitSpace(references, range, left, right, parallel))
            moveReferences(references, range, object, right.count, parallel);
        if (range.capacity > left.count + right.count) {
            left.demand = demand(references.left(range), left.count, parallel);
            right.demand = demand(references.right(range, right.count), right.count, parallel);
        }
        return true;
    }

  private:
    /// Cuts a range if that costs less than its object split, whose sides are `left` and `right`. If not,
    /// leaves them as they are. Returns whether it did.
    bool splitSpace(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
                    bool parallel) const {
        // Find a plane, if there is room for more references and the object split is bad enough.
        if (range.capacity == range.count) return false;
        if (overlapArea(left.bounds, right.bounds) <= minOverlap(range.count) * range.bounds.halfArea())
            return false;
        const float objectCost =
            left.bounds.halfArea() * float(left.count) + right.bounds.halfArea() * float(right.count);
        SpatialSplit split(range.bounds, bins_ == 0 ? defaultSlabs(range.count) : std::min(bins_, kMaxSlabs),
                           parallel ? kGrain : range.count);
        if (!findSpatialSplit(scene_, references.at(range), range.count, range.capacity, split)) return false;
        if (!(split.plane.cost < objectCost)) return false;

        // Move the references; decide which of those that the plane cuts stay whole; then place the parts.
        Buffer<Crossing> crossings(split.plane.leftCount + split.plane.rightCount - range.count);
        Range sides[2];
        moveWholes(references, range, split, crossings, sides);
        if (!decide(split.plane, crossings, sides)) return false;
        for (int side = 0; side < 2; ++side) {
            // Parts come after the whole references on the left, and before those on the right.
            Reference* to = side == 0 ? references.left(range) + (range.count - split.plane.rightCount)
                                      : references.right(range, sides[1].count);
            for (size_t i = 0; i < crossings.size(); ++i) {
                if (!crossings[i].has(side)) continue;
                std::memcpy(static_cast<void*>(to), &crossings[i].parts[side], sizeof *to);
                to++->primitive = crossings[i].whole.primitive;
            }
        }
        left = sides[0];
        right = sides[1];
        return true;
    }

    /// Moves the references that the plane does not cut, and cuts the others. Sets the bounds of the sides to
    /// those of the whole references.
    void moveWholes(const ReferenceArrays& references, const Range& range, const SpatialSplit& split,
                    Buffer<Crossing>& crossings, Range (&sides)[2]) const {
        const Reference* source = references.at(range);
        const int axis = split.plane.axis;
        const float at = split.slabs.plane(axis, split.plane.lastLeft + 1);
        std::vector<Box> wholes(2 * split.chunks.size());
        parallelChunks(range.count, split.grain, [&](size_t begin, size_t end) {
            const size_t chunk = begin / split.grain;
            const auto [leftBefore, crossingBefore] = split.chunks[chunk];
            Crossing* crossing = crossings.data() + crossingBefore;
            Reference* left = references.left(range) + leftBefore;
            Reference* right = references.right(range, range.count - split.plane.leftCount) +
                               (begin - leftBefore - crossingBefore);
            BoxV lefts = BoxV::empty(), rights = BoxV::empty();
            for (size_t i = begin; i < end; ++i) {
                const BoxV box = BoxV::load(floats(source + i));
                const Side side = sideOf(source[i], split);
                if (side == Side::left) {
                    lefts = unite(lefts, box);
                    box.store(reinterpret_cast<float*>(left++));
                } else if (side == Side::right) {
                    rights = unite(rights, box);
                    box.store(reinterpret_cast<float*>(right++));
                } else {
                    cut(source[i], axis, at, *crossing++);
                }
            }
            lefts.store(wholes[2 * chunk].negatedMin);
            rights.store(wholes[2 * chunk + 1].negatedMin);
        });
        for (size_t side = 0; side < 2; ++side) {
            sides[side].bounds = Box::empty();
            for (size_t i = side; i < wholes.size(); i += 2) sides[side].bounds.extend(wholes[i]);
        }
    }

    /// Cuts a reference at a plane into its two parts.
    void cut(const Reference& reference, int axis, float at, Crossing& crossing) const {
        const Aabb box = boxOf(reference).toAabb();
        const Triangle triangle = scene_.triangle(reference.primitive);
        Aabb halves[2] = {box, box};
        halves[0].max[axis] = std::min(box.max[axis], at);
        halves[1].min[axis] = std::max(box.min[axis], at);
        crossing.whole = reference;
        for (int side = 0; side < 2; ++side) {
            const Aabb part = intersection(partBounds(triangle, halves[side]), box);
            crossing.parts[side] = part.isEmpty() ? Box::empty() : boxOf(part);
        }
    }

    /// Decides for each cut reference whether it stays whole on one side, by least cost. Completes the bounds
    /// and counts of the sides. Returns false if nothing would be left on one side.
    static bool decide(const SpatialPlane& plane, Buffer<Crossing>& crossings, Range (&sides)[2]) {
        sides[0].count = plane.leftCount;
        sides[1].count = plane.rightCount;
        Box bounds[2] = {sides[0].bounds, sides[1].bounds};
        for (size_t i = 0; i < crossings.size(); ++i)
            for (int side = 0; side < 2; ++side) bounds[side].extend(crossings[i].parts[side]);
        for (size_t i = 0; i < crossings.size(); ++i) {
            Crossing& crossing = crossings[i];
            const Box whole = boxOf(crossing.whole);
            int keep = -1;
            if (crossing.has(0) && crossing.has(1)) {
                const float areas[2] = {bounds[0].halfArea(), bounds[1].halfArea()};
                float least = areas[0] * float(sides[0].count) + areas[1] * float(sides[1].count);
                for (int side = 0; side < 2; ++side) {
                    if (sides[1 - side].count == 1) continue;
                    const float cost = united(bounds[side], whole).halfArea() * float(sides[side].count) +
                                       areas[1 - side] * float(sides[1 - side].count - 1);
                    if (cost > least) continue;
                    least = cost;
                    keep = side;
                }
                if (keep >= 0) {
                    crossing.parts[keep] = whole;
                    crossing.parts[1 - keep] = Box::empty();
                    bounds[keep].extend(whole);
                }
            } else {  // the box crosses the plane, but the triangle's part in the box does not
                keep = crossing.has(1);
                if (!crossing.has(keep)) crossing.parts[keep] = whole;
                if (sides[1 - keep].count == 1) return false;
            }
            if (keep >= 0) --sides[1 - keep].count;
            for (int side = 0; side < 2; ++side) sides[side].bounds.extend(crossing.parts[side]);
        }
        return true;
    }

    static float demand(const Reference* references, uint32_t count, bool parallel) {
        if (!parallel) return demandOf(references, count);
        std::vector<float> chunks((count + kGrain - 1) / kGrain);
        parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
            chunks[begin / kGrain] = demandOf(references + begin, uint32_t(end - begin));
        });
        float sum = 0;
        for (const float chunk : chunks) sum += chunk;
        return sum;
    }

    const Scene& scene_;
    const uint32_t bins_;
};

Bvh build(const Scene& scene, const BuildOptions& options) {
    SpatialSplitter splitter(scene, options.bins);
    const double triangles = double(scene.triangles.size());
    // There are twice as many nodes as references, and each needs an index.
    const double room = std::min(triangles * double(options.splitBudget), 0x7FFFFFFF - triangles);
    return TopDownBuild<SpatialSplitter>(options, splitter, uint32_t(std::max(room, 0.0))).build(scene);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {

HWY_EXPORT(build);

Bvh buildSpatial(const Scene& scene, const BuildOptions& options) {
    checkBins(options);
    if (!(options.splitBudget >= 0 && options.splitBudget <= kMaxSplitBudget))
        throw Error(ErrorKind::usage, "the split budget must be from 0 to 16");
    return HWY_DYNAMIC_DISPATCH(build)(scene, options);
}

}  // namespace bvhio
#endif
