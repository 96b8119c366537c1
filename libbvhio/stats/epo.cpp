// T. Aila, T. Karras, S. Laine, "On Quality Metrics of Bounding Volume Hierarchies", HPG 2013, section 3.
// Departures:
//
// - The paper clips every triangle against every node. We carry the clipped part of a triangle down the tree,
//   since a child's box lies inside its parent's.
// - Large scenes are sampled: pairs of draws in strata of equal surface area, where each triangle is drawn
//   with probability proportional to its area, so that nearly all large triangles, which have most of the
//   overlap, are clipped.

#include "stats/epo.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "stats/convex_polygon.h"

namespace bvhio {
namespace {

/// An index of the triangles that have a reference below each node. Leaves are numbered depth first, so the
/// leaves of a node are a range.
class SubtreeIndex {
  public:
    SubtreeIndex(const Bvh& bvh, size_t triangleCount)
        : leafRanges_(bvh.nodes.size()), offsets_(triangleCount + 1) {
        for (uint32_t triangle : bvh.primitives) ++offsets_[triangle + 1];
        std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
        leaves_.resize(bvh.primitives.size());

        std::vector<uint32_t> filled(offsets_.begin(), offsets_.end() - 1), open{0};
        uint32_t nextLeaf = 0;
        while (!open.empty()) {
            const uint32_t index = open.back();
            const Node& node = bvh.nodes[index];
            open.pop_back();
            leafRanges_[index].first = nextLeaf;
            if (node.isLeaf()) {
                for (uint32_t i = 0; i < node.primitiveCount; ++i)
                    leaves_[filled[bvh.primitives[node.first + i]]++] = nextLeaf;
                leafRanges_[index].last = ++nextLeaf;
            } else {
                open.push_back(node.right());
                open.push_back(node.left());
            }
        }
        for (size_t i = bvh.nodes.size(); i-- > 0;)  // children come after their parents
            if (i != 1 && !bvh.nodes[i].isLeaf())
                leafRanges_[i].last = leafRanges_[bvh.nodes[i].right()].last;
    }

    bool isBelow(uint32_t triangle, uint32_t node) const {
        const auto end = leaves_.begin() + offsets_[triangle + 1];
        const auto leaf =
            std::lower_bound(leaves_.begin() + offsets_[triangle], end, leafRanges_[node].first);
        return leaf != end && *leaf < leafRanges_[node].last;
    }

  private:
    struct LeafRange {
        uint32_t first, last;
    };
    std::vector<LeafRange> leafRanges_;  // by node
    std::vector<uint32_t> offsets_;      // by triangle, into leaves_
    std::vector<uint32_t> leaves_;       // the leaves of each triangle, ascending
};

/// Computes the sum of one triangle, on its way down the tree.
class OverlapSum {
  public:
    OverlapSum(const Bvh& bvh, const SubtreeIndex& subtrees, const SahCosts& costs, uint32_t triangle)
        : bvh_(bvh), subtrees_(subtrees), costs_(costs), triangle_(triangle) {}

    /// Returns the sum of C_n * (area inside n) over the nodes n below `inner` that do not have the triangle
    /// below them. `part` is the triangle's part inside inner's box, and `isOwn` says whether the triangle is
    /// below inner.
    double below(const Node& inner, const ConvexPolygon& part, bool isOwn) const {
        double sum = 0;
        for (const uint32_t child : {inner.left(), inner.right()}) {
            const Node& node = bvh_.nodes[child];
            const ConvexPolygon::Place place = part.placeIn(node.bounds);
            if (place == ConvexPolygon::Place::outside) continue;
            const bool isChildOwn = isOwn && subtrees_.isBelow(triangle_, child);
            if (isChildOwn && node.isLeaf()) continue;
            if (place == ConvexPolygon::Place::inside) {
                sum += at(node, part, isChildOwn);
            } else {
                const ConvexPolygon clipped = part.clippedTo(node.bounds);
                if (!clipped.isEmpty()) sum += at(node, clipped, isChildOwn);
            }
        }
        return sum;
    }

  private:
    double at(const Node& node, const ConvexPolygon& part, bool isOwn) const {
        if (node.isLeaf()) return double(costs_.intersection) * node.primitiveCount * part.area();
        return (isOwn ? 0 : costs_.traversal * part.area()) + below(node, part, isOwn);
    }

    const Bvh& bvh_;
    const SubtreeIndex& subtrees_;
    const SahCosts& costs_;
    uint32_t triangle_;
};

/// Returns for each of `triangles` the sum of C_n * (area inside n) over the nodes n that do not have it
/// below them.
std::vector<double> overlaps(const Scene& scene, const Bvh& bvh, const SahCosts& costs,
                             std::span<const uint32_t> triangles) {
    std::vector<double> sums(triangles.size());
    if (bvh.nodes[0].isLeaf()) return sums;
    const SubtreeIndex subtrees(bvh, scene.triangles.size());
    parallelChunks(triangles.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const ConvexPolygon whole(scene.triangle(triangles[i]));
            if (whole.area() > 0)
                sums[i] = OverlapSum(bvh, subtrees, costs, triangles[i]).below(bvh.nodes[0], whole, true);
        }
    });
    return sums;
}

Epo exactEpo(const Scene& scene, const Bvh& bvh, const SahCosts& costs, double totalArea) {
    std::vector<uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    const std::vector<double> sums = overlaps(scene, bvh, costs, all);
    return {std::accumulate(sums.begin(), sums.end(), 0.0) / totalArea, 0, all.size(), true};
}

/// Estimates the EPO by two draws from each stratum of equal area. The mean of the draws is the estimate, and
/// their differences give its error.
Epo sampledEpo(const Scene& scene, const Bvh& bvh, const SahCosts& costs, const EpoOptions& options,
               std::span<const double> areasUpTo) {
    const size_t strata = std::max<size_t>(1, (size_t(options.samples) + 1) / 2);
    const double totalArea = areasUpTo.back();
    std::vector<uint32_t> draws(2 * strata);
    Random random(options.seed);
    for (size_t i = 0; i < draws.size(); ++i) {
        const double place = (double(i / 2) + random.uniform()) / double(strata) * totalArea;
        // The first triangle that reaches beyond `place`, which has an area. Rounding may put `place` at the
        // very end.
        const auto found = std::min(std::upper_bound(areasUpTo.begin(), areasUpTo.end(), place),
                                    std::lower_bound(areasUpTo.begin(), areasUpTo.end(), totalArea));
        draws[i] = uint32_t(found - areasUpTo.begin());
    }
    std::vector<uint32_t> triangles = draws;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());

    const std::vector<double> sums = overlaps(scene, bvh, costs, triangles);
    const auto overlapPerArea = [&](uint32_t triangle) {
        const auto i = std::lower_bound(triangles.begin(), triangles.end(), triangle) - triangles.begin();
        return sums[size_t(i)] / area(scene.triangle(triangle));
    };
    double sum = 0, squares = 0;
    for (size_t s = 0; s < strata; ++s) {
        const double a = overlapPerArea(draws[2 * s]), b = overlapPerArea(draws[2 * s + 1]);
        sum += 0.5 * (a + b);
        squares += 0.25 * (a - b) * (a - b);
    }
    return {sum / double(strata), std::sqrt(squares) / double(strata), triangles.size(), false};
}

}  // namespace

Epo epo(const Scene& scene, const Bvh& bvh, const SahCosts& costs, const EpoOptions& options) {
    std::vector<double> areasUpTo(scene.triangles.size());
    double totalArea = 0;
    for (size_t i = 0; i < areasUpTo.size(); ++i) areasUpTo[i] = totalArea += area(scene.triangle(i));
    if (!(totalArea > 0)) return {0, 0, scene.triangles.size(), true};
    if (scene.triangles.size() <= options.exactUpTo) return exactEpo(scene, bvh, costs, totalArea);
    return sampledEpo(scene, bvh, costs, options, areasUpTo);
}

}  // namespace bvhio
