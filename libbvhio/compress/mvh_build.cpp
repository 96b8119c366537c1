#include "compress/mvh_build.h"

#include <algorithm>
#include <bit>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "core/parallel.h"
#include "tree/sah_cost.h"

namespace bvhio {
namespace {

constexpr double kInnerCost = SahCosts{}.traversal;
// From these sizes on, runs are split by several threads, and subtrees are tasks of their own.
constexpr size_t kParallelRun = 16384, kParallelSubtree = 4096;

/// A key by which a run can be sorted: the centre, low side or high side of boxes, along an axis.
struct Key {
    uint32_t kind, axis;

    template <uint32_t kind>
    static float of(const MvhReference& r, uint32_t axis) {
        const float min = component(r.min, int(axis)), max = component(r.max, int(axis));
        return kind == 0 ? min * 0.5f + max * 0.5f : kind == 1 ? min : max;
    }
    /// Calls body with the function that returns the key of a reference.
    template <class Body>
    auto with(const Body& body) const {
        const auto at = [a = axis](auto k) {
            return [a](const MvhReference& r) { return of<decltype(k)::value>(r, a); };
        };
        return kind == 0   ? body(at(std::integral_constant<uint32_t, 0>()))
               : kind == 1 ? body(at(std::integral_constant<uint32_t, 1>()))
                           : body(at(std::integral_constant<uint32_t, 2>()));
    }
};

/// Returns the place of a reference in the order of a key. All places differ.
uint64_t placeOf(float key, uint32_t primitive) {
    const auto bits = std::bit_cast<uint32_t>(key);
    const uint32_t ordered = bits ^ (uint32_t(int32_t(bits) >> 31) | 0x80000000u);
    return uint64_t(ordered) << 32 | primitive;
}

/// A growing box, in the lanes of references. The last lanes are undefined.
class Extent {
  public:
    void extend(const MvhReference& r) {
#if defined(__SSE__)
        min_ = _mm_min_ps(min_, _mm_load_ps(&r.min.x));
        max_ = _mm_max_ps(max_, _mm_load_ps(&r.max.x));
#else
        box_.extend(r.box());
#endif
    }
#if defined(__SSE__)
    Aabb box() const {
        alignas(16) float min[4], max[4];
        _mm_store_ps(min, min_);
        _mm_store_ps(max, max_);
        return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
    }

  private:
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();
    __m128 min_ = _mm_set1_ps(kInfinity), max_ = _mm_set1_ps(-kInfinity);
#else
    Aabb box() const {
        return box_;
    }

  private:
    Aabb box_ = Aabb::empty();
#endif
};

/// A cut of a run: the place of the cut, and the bounds of the references below it and of the others.
struct Halves {
    uint64_t place;
    Aabb low, high;
};

/// Cuts a run of at most kSmall references after the first `rank` in the order of the key. Counts the
/// references before each one: sorting so few is slower, because its branches cannot be predicted.
constexpr size_t kSmall = 16;
template <class KeyOf>
Halves halveSmall(std::span<const MvhReference> run, const KeyOf& keyOf, size_t rank) {
    uint64_t places[kSmall] = {};
    for (size_t i = 0; i < run.size(); ++i) places[i] = placeOf(keyOf(run[i]), run[i].primitive);
    uint64_t place = 0;
    Extent sides[2];
    for (size_t i = 0; i < run.size(); ++i) {
        size_t before = 0;
        for (size_t j = 0; j < run.size(); ++j) before += places[j] < places[i];
        if (before == rank) place = places[i];
        sides[before >= rank].extend(run[i]);
    }
    return {place, sides[0].box(), sides[1].box()};
}

/// Does the same for a run of any length with keys in [low, high]. A histogram of the keys gives the bin of
/// the cut, and only the references of that bin are sorted.
template <class KeyOf>
Halves halveLarge(std::span<const MvhReference> run, float low, float high, const KeyOf& keyOf, size_t rank) {
    constexpr uint32_t kMostBins = 256;
    const uint32_t bins = run.size() < 256 ? 32 : kMostBins;
    const float last = float(bins - 1), scale = float(bins) / (high - low);
    // Bins are monotone in the key, even with overflow. The first bin takes NaNs (0 times infinity), and
    // centres that rounding moves below the box, as happens with denormals.
    const auto binOf = [&](float value) {
        const float bin = (value - low) * scale;
        return bin > 0 ? uint32_t(int32_t(bin < last ? bin : last)) : 0u;
    };

    // Find the bin of the cut.
    uint32_t counts[kMostBins];
    std::fill_n(counts, bins, 0u);
    for (const MvhReference& r : run) ++counts[binOf(keyOf(r))];
    uint32_t bin = 0;
    size_t below = 0;
    while (below + counts[bin] <= rank) below += counts[bin++];

    // Collect the references of that bin, and the bounds of the others.
    struct Place {
        uint64_t place;
        const MvhReference* reference;
    };
    static thread_local std::vector<Place> middle;
    middle.resize(counts[bin]);
    size_t found = 0;
    Extent sides[2];
    for (const MvhReference& r : run) {
        const float value = keyOf(r);
        const uint32_t b = binOf(value);
        if (b == bin)
            middle[found++] = {placeOf(value, r.primitive), &r};
        else
            sides[b > bin].extend(r);
    }

    // Find the cut in the bin.
    const auto cut = middle.begin() + std::ptrdiff_t(rank - below);
    std::nth_element(middle.begin(), cut, middle.end(),
                     [](const Place& a, const Place& b) { return a.place < b.place; });
    for (auto m = middle.begin(); m != middle.end(); ++m) sides[m >= cut].extend(*m->reference);
    return {cut->place, sides[0].box(), sides[1].box()};
}

Aabb boundsOf(std::span<const MvhReference> run) {
    Extent extent;
    for (const MvhReference& r : run) extent.extend(r);
    return extent.box();
}

/// A division of a run between the children of a node.
struct Split {
    Key key{};
    uint64_t place = 0;
    bool lowIsLeft = true;
    Aabb left, right;
    double cost = std::numeric_limits<double>::infinity();
};

class Order {
  public:
    Order(const MvhParameters& parameters, MvhBuild build) : parameters_(parameters), build_(build) {}

    /// Sorts a run into the order of leaves. `box` is the node's reconstructed box, and `tight` the bounds of
    /// its references.
    void operator()(std::span<MvhReference> run, const MvhBox& box, const Aabb& tight) const {
        const size_t count = run.size();
        if (count <= parameters_.leafSize) {
            std::sort(run.begin(), run.end(),
                      [](const MvhReference& a, const MvhReference& b) { return a.primitive < b.primitive; });
            return;
        }
        const size_t leftCount = MvhShape::leftCount(uint32_t(count), parameters_.leafSize);
        const MvhCuts cuts(box, parameters_.rule);
        const Split split = build_ == MvhBuild::paper ? paperSplit(run, tight, leftCount, cuts)
                                                      : bestSplit(run, box, tight, leftCount, cuts);
        split.key.with([&](const auto& keyOf) {
            return std::partition(run.begin(), run.end(), [&](const MvhReference& r) {
                return (placeOf(keyOf(r), r.primitive) < split.place) == split.lowIsLeft;
            });
        });
        const auto left = run.first(leftCount), right = run.subspan(leftCount);
        const MvhBox leftBox = cuts.child(box, cuts.code(split.left)),
                     rightBox = cuts.child(box, cuts.code(split.right));
        if (count < kParallelSubtree) {
            (*this)(left, leftBox, split.left);
            (*this)(right, rightBox, split.right);
        } else {
            TaskGroup tasks;
            tasks.run([&] { (*this)(left, leftBox, split.left); });
            (*this)(right, rightBox, split.right);
            tasks.wait();
        }
    }

  private:
    static Halves halve(std::span<const MvhReference> run, const Aabb& tight, Key key, size_t rank) {
        const float low = component(tight.min, int(key.axis)), high = component(tight.max, int(key.axis));
        return key.with([&](const auto& keyOf) {
            return run.size() <= kSmall ? halveSmall(run, keyOf, rank)
                                        : halveLarge(run, low, high, keyOf, rank);
        });
    }

    Split paperSplit(std::span<const MvhReference> run, const Aabb& tight, size_t leftCount,
                     const MvhCuts& cuts) const {
        const Key key{0, cuts.axis};
        const Halves halves = halve(run, tight, key, leftCount);
        return {key, halves.place, true, halves.low, halves.high, 0};
    }

    Split bestSplit(std::span<const MvhReference> run, const MvhBox& box, const Aabb& tight, size_t leftCount,
                    const MvhCuts& cuts) const {
        // All but one node of a level are halved evenly. In that one the larger part can be at either end.
        const size_t ends = 2 * leftCount == run.size() ? 1 : 2;
        Split splits[18];
        const auto evaluate = [&](size_t i) {
            const bool lowIsLeft = i < 9;
            const Key key{uint32_t(i % 9 / 3), uint32_t(i % 3)};
            const Halves halves = halve(run, tight, key, lowIsLeft ? leftCount : run.size() - leftCount);
            Split& split = splits[i];
            split = {key, halves.place, lowIsLeft, halves.low, halves.high, 0};
            if (!lowIsLeft) std::swap(split.left, split.right);
            split.cost = cost(split.left, box, cuts) * double(leftCount) +
                         cost(split.right, box, cuts) * double(run.size() - leftCount);
        };
        if (run.size() < kParallelRun)
            for (size_t i = 0; i < 9 * ends; ++i) evaluate(i);
        else
            parallelChunks(9 * ends, 1, [&](size_t i, size_t) { evaluate(i); });
        Split best = *std::min_element(splits, splits + 9 * ends,
                                       [](const Split& a, const Split& b) { return a.cost < b.cost; });
        // Rays assume that the left child is the lower one along the axis of the cuts.
        const auto axis = int(cuts.axis);
        if (ends == 1 && best.left.center()[axis] > best.right.center()[axis]) {
            best.lowIsLeft = false;
            std::swap(best.left, best.right);
        }
        return best;
    }

    /// Returns the cost of a child with these bounds, for each of its primitives. Rays meet its reconstructed
    /// box. Its own children start from what it can still become: the box after one more cut, and in the end
    /// the tight box.
    double cost(const Aabb& tight, const MvhBox& parent, const MvhCuts& cuts) const {
        const MvhBox box = cuts.child(parent, cuts.code(tight));
        const MvhCuts next(box, parameters_.rule);
        return halfArea(box.bounds) + halfArea(next.child(box, next.code(tight)).bounds) +
               2 * halfArea(tight);
    }

    MvhParameters parameters_;
    MvhBuild build_;
};

}  // namespace

std::vector<MvhReference> mvhReferences(const Scene& scene) {
    std::vector<MvhReference> references(scene.triangles.size());
    parallelChunks(references.size(), 16384, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            references[i] = MvhReference(bounds(scene.triangle(i)), uint32_t(i));
    });
    return references;
}

void orderMvh(std::span<MvhReference> run, const Aabb& root, const MvhParameters& parameters,
              MvhBuild build) {
    Order(parameters, build)(run, {root}, boundsOf(run));
}

MvhCoder::MvhCoder(std::span<const MvhReference> run, const Aabb& root, uint32_t leafSize)
    : shape_(uint32_t(run.size()), leafSize), root_(root), tight_(shape_.nodeCount()) {
    for (uint32_t node = shape_.nodeCount(); node-- > 0;) {
        if (shape_.isLeaf(node)) {
            const PrimitiveRange range = shape_.primitiveRange(node);
            tight_[node] = boundsOf(run.subspan(range.first, range.count));
        } else {
            tight_[node] = unite(tight_[2 * node + 1], tight_[2 * node + 2]);
        }
    }
}

template <class Visit>
double MvhCoder::descend(uint32_t node, const MvhBox& box, const MvhRule& rule, const Visit& visit) const {
    const double area = halfArea(box.bounds);
    if (shape_.isLeaf(node)) return area * shape_.primitiveRange(node).count;
    const MvhCuts cuts(box, rule);
    const uint32_t left = cuts.code(tight_[2 * node + 1]), right = cuts.code(tight_[2 * node + 2]);
    visit(node, left | right << 2);
    const double leftCost = descend(2 * node + 1, cuts.child(box, left), rule, visit);
    return kInnerCost * area + leftCost + descend(2 * node + 2, cuts.child(box, right), rule, visit);
}

void MvhCoder::code(const MvhRule& rule, uint8_t* nibbles) const {
    descend(0, {root_}, rule, [&](uint32_t node, uint32_t codes) { nibbles[node] = uint8_t(codes); });
}

double MvhCoder::cost(const MvhRule& rule) const {
    return descend(0, {root_}, rule, [](uint32_t, uint32_t) {});
}

}  // namespace bvhio
