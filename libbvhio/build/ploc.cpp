// PLOC (Meister and Bittner 2018, "Parallel locally-ordered clustering for bounding volume hierarchy
// construction"; with later work's finer points, Benthin et al. 2022, "PLOC++"): clusters, at first one a
// triangle, in Morton order. In each round every cluster finds the one within a radius in the order with
// which its common box is smallest, and those that find each other are joined. Departures:
// - Equal distances are told apart by i ^ j, the places' difference in bits: so a million equal boxes pair up
//   with their neighbours at once. Chains in which each finds the one before it, with few mutual pairs, are
//   followed by a round that joins neighbours in the order.
// - Greedy joining is a little worse than top-down splits where surfaces are smooth, and better on parts of
//   mixed sizes. So the clusters left when they are an eighth of the triangles get both trees, and the
//   cheaper one is kept.
// - Which subtrees become leaves is decided as they are joined (merged_tree).

#include "build/ploc.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "build/binned.h"
#include "build/merged_tree.h"
#include "build/morton.h"
#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/ploc.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

#ifndef BVHIO_BUILD_PLOC_CPP
#define BVHIO_BUILD_PLOC_CPP
namespace bvhio {
namespace {

constexpr uint32_t kSearchGrain = 1 << 10;  // clusters that a task searches for
constexpr uint32_t kRadius = 16;            // a power of two

/// Partners of cluster i are i + k and i - k, k from 1 to kRadius. Two clusters call each other by the same
/// number, lower for smaller k: 2 (k - 1), and 1 more for every other pair at that distance. For that, pairs
/// at distance k = 2^n * odd number alternate with bit n of their first one.
constexpr uint32_t kPartners = 2 * kRadius;

/// Where the partners are: what to add to i. At most log2 of kRadius and one more low bits of i matter.
struct PartnerOffsets {
    int8_t offsets[kPartners][kPartners];

    constexpr PartnerOffsets() : offsets{} {
        for (uint32_t i = 0; i < kPartners; ++i)
            for (uint32_t number = 0; number < kPartners; ++number) {
                const uint32_t k = number / 2 + 1;
                const bool isAfter = (i >> std::countr_zero(k) & 1) == (number & 1);
                offsets[i][number] = int8_t(isAfter ? int(k) : -int(k));
            }
    }
    int operator()(uint32_t i, uint8_t number) const { return offsets[i % kPartners][number]; }
};

}  // namespace
}  // namespace bvhio
#endif

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

using Lanes = hn::ScalableTag<float>;
using LanesU = hn::RebindToUnsigned<Lanes>;

/// The boxes around a chunk of clusters, each coordinate by itself; far away where there are none.
class Surroundings {
  public:
    Surroundings(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end) {
        const int64_t first = int64_t(begin) - kRadius, last = int64_t(end) + kRadius + kMostLanes;
        const int64_t from = std::max<int64_t>(first, 0), to = std::min<int64_t>(last, count);
        for (auto& numbers : numbers_) {
            std::fill(numbers, numbers + (from - first), kFar);
            std::fill(numbers + (to - first), numbers + (last - first), kFar);
        }
        for (int64_t i = from; i < to; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                numbers_[axis][i - first] = clusters[i].negatedMin[axis];
                numbers_[axis + 3][i - first] = clusters[i].max[axis];
            }
    }

    /// A coordinate of the boxes from the chunk's place `i` on.
    HWY_INLINE hn::Vec<Lanes> load(int number, int64_t i) const {
        return hn::LoadU(Lanes(), numbers_[number] + kRadius + i);
    }

  private:
    static constexpr uint32_t kMostLanes = 64;
    static constexpr float kFar = 0x1p60f;
    alignas(64) float numbers_[6][kSearchGrain + 2 * kRadius + kMostLanes];
};

/// Finds the nearest one for each cluster of [begin, end).
void findNearest(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end, uint8_t* nearest) {
    const Lanes d;
    const LanesU du;
    using V = hn::Vec<Lanes>;
    using VU = hn::Vec<LanesU>;
    const Surroundings boxes(clusters, count, begin, end);
    const auto lanes = uint32_t(hn::Lanes(d));
    const VU one = hn::Set(du, 1), distance = hn::Set(du, ~(kPartners - 1));
    for (uint32_t i = 0; begin + i < end; i += lanes) {
        const V x0 = boxes.load(0, i), y0 = boxes.load(1, i), z0 = boxes.load(2, i), x1 = boxes.load(3, i),
                y1 = boxes.load(4, i), z1 = boxes.load(5, i);
        // The area of the common box, and in its lowest bits the partner.
        const auto rate = [&](int64_t j, VU partner) HWY_ATTR {
            const V x = hn::Add(hn::Max(x0, boxes.load(0, j)), hn::Max(x1, boxes.load(3, j)));
            const V y = hn::Add(hn::Max(y0, boxes.load(1, j)), hn::Max(y1, boxes.load(4, j)));
            const V z = hn::Add(hn::Max(z0, boxes.load(2, j)), hn::Max(z1, boxes.load(5, j)));
            const V area = hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
            return hn::Or(hn::And(hn::BitCast(du, area), distance), partner);
        };
        VU least = hn::Set(du, ~0u);
        const VU places = hn::Iota(du, begin + i);
        for (uint32_t k = 1; k <= kRadius; ++k) {
            const VU side = hn::And(hn::ShiftRightSame(places, std::countr_zero(k)), one);
            const VU after = hn::Or(side, hn::Set(du, 2 * (k - 1)));
            least = hn::Min(least, rate(int64_t(i) + k, after));
            least = hn::Min(least, rate(int64_t(i) - k, hn::Xor(after, one)));
        }
        alignas(64) uint32_t found[64];
        hn::Store(least, du, found);
        for (uint32_t lane = 0; lane < std::min(end - begin - i, lanes); ++lane)
            nearest[begin + i + lane] = uint8_t(found[lane] % kPartners);
    }
}

/// The clusters of one triangle each at places [begin, end) of the order.
void makeClusters(const Scene& scene, const MortonOrder& order, uint32_t begin, uint32_t end,
                  Reference* clusters) {
    constexpr uint32_t kAhead = 32;
    const TriangleBoxes boxes(scene, order.scale);
    for (uint32_t i = begin; i < end; ++i) {
        hwy::Prefetch(&scene.triangles[order.triangles[std::min(i + 2 * kAhead, end - 1)]]);
        boxes.prefetch(scene.triangles[order.triangles[std::min(i + kAhead, end - 1)]]);
        boxes(scene.triangles[order.triangles[i]]).store(reinterpret_cast<float*>(clusters + i));
        clusters[i].primitive = MergedTree::leafKey(i);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(findNearest);
HWY_EXPORT(makeClusters);

class PlocBuild {
  public:
    PlocBuild(const Scene& scene, const BuildOptions& options)
        : scene_(scene),
          options_(options),
          order_(mortonOrder(scene)),
          count_(uint32_t(scene.triangles.size())),
          tree_(scene, order_,
                {options.costs.traversal, options.costs.intersection, std::max(options.maxLeafSize, 1u)}),
          clusters_(count_),
          joined_(count_),
          nearest_(count_ + size_t(1)) {}

    Bvh build() && {
        const uint32_t triangles = count_;
        Progress* const progress = options_.progress;
        if (progress) progress->start(triangles);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            HWY_DYNAMIC_DISPATCH(makeClusters)
            (scene_, order_, uint32_t(begin), uint32_t(end), clusters_.data());
        });
        joinUntil(std::max(triangles / kUpperShare, 1u));
        if (count_ > 1) joinUpper();
        if (progress) progress->add(triangles - progress->done);
        Bvh bvh = tree_.finish(clusters_[0]);
        if (order_.scale != 1) bvh.nodes = refitted(scene_, bvh);
        return bvh;
    }

  private:
    static constexpr size_t kGrain = 1 << 12;
    static constexpr uint32_t kUpperShare = 8;
    static constexpr uint32_t kAhead = 16;  // clusters to ask for before they are joined

    void joinUntil(uint32_t count) {
        while (count_ > count) {
            const uint32_t before = count_;
            findNearestOfAll();
            joinNearest();
            if (options_.progress) options_.progress->add(before - count_);
            if (before - count_ < before / 32) {
                std::fill_n(nearest_.data(), count_, uint8_t(0));  // i and i ^ 1
                joinNearest();
            }
        }
    }

    void findNearestOfAll() {
        parallelChunks(count_, kSearchGrain, [&](size_t begin, size_t end) {
            HWY_DYNAMIC_DISPATCH(findNearest)
            (clusters_.data(), count_, uint32_t(begin), uint32_t(end), nearest_.data());
        });
    }

    /// Joins clusters that have each other in `nearest_`. The joined one takes the first one's place.
    void joinNearest() {
        static constexpr PartnerOffsets kOffsets;
        nearest_[count_] = kPartners;  // nobody's partner
        struct Chunk {
            uint32_t kept = 0, joined = 0;
        };
        std::vector<Chunk> chunks((count_ + kGrain - 1) / kGrain);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            Chunk chunk;
            for (auto i = uint32_t(begin); i < end; ++i) {
                const int offset = kOffsets(i, nearest_[i]);
                const bool isJoined = nearest_[i + uint32_t(offset)] == nearest_[i];
                chunk.kept += !(isJoined && offset < 0);
                chunk.joined += isJoined && offset > 0;
            }
            chunks[begin / kGrain] = chunk;
        });
        Chunk sum{0, pairCount_};
        for (Chunk& chunk : chunks) {
            const Chunk own = std::exchange(chunk, sum);
            sum.kept += own.kept;
            sum.joined += own.joined;
        }
        tree_.startRound(pairCount_);
        parallelChunks(count_, kGrain, [&](size_t begin, size_t end) {
            auto [to, pair] = chunks[begin / kGrain];
            // First all that stay, then the joined ones over the first of each pair: no branch that nobody
            // can predict.
            struct Joined {
                uint32_t first, second, to;
            };
            Joined joined[kGrain];
            uint32_t joinedCount = 0;
            for (auto i = uint32_t(begin); i < end; ++i) {
                const int offset = kOffsets(i, nearest_[i]);
                const bool isJoined = nearest_[i + uint32_t(offset)] == nearest_[i];
                joined[joinedCount] = {i, i + uint32_t(offset), to};
                joinedCount += isJoined && offset > 0;
                const bool stays = !(isJoined && offset < 0);
                if (stays) joined_[to] = clusters_[i];
                to += stays;
            }
            for (uint32_t k = 0; k < joinedCount; ++k) {
                const Joined& ahead = joined[std::min(k + kAhead, joinedCount - 1)];
                tree_.prefetch(clusters_[ahead.first]);
                tree_.prefetch(clusters_[ahead.second]);
                const auto [first, second, at] = joined[k];
                joined_[at] = tree_.join(pair++, clusters_[first], clusters_[second]);
            }
        });
        std::swap(clusters_, joined_);
        count_ = sum.kept;
        pairCount_ = sum.joined;
    }

    /// Joins the remaining clusters, or splits them from the root down if that is cheaper.
    void joinUpper() {
        const uint32_t remaining = count_, firstPair = pairCount_;
        Buffer<Reference> lower(remaining), references(remaining);
        struct Sum {
            Box bounds = Box::empty();
            float cost = 0;
        };
        std::vector<Sum> chunks((remaining + kGrain - 1) / kGrain);
        parallelChunks(remaining, kGrain, [&](size_t begin, size_t end) {
            Sum& sum = chunks[begin / kGrain];
            for (size_t i = begin; i < end; ++i) {
                const Reference& cluster = lower[i] = references[i] = clusters_[i];
                references[i].primitive = uint32_t(i);
                sum.bounds.extend({{cluster.negatedMin[0], cluster.negatedMin[1], cluster.negatedMin[2], 0},
                                   {cluster.max[0], cluster.max[1], cluster.max[2], 0}});
                sum.cost += tree_.cost(cluster);
            }
        });
        Sum all;
        for (const Sum& sum : chunks) {
            all.bounds.extend(sum.bounds);
            all.cost += sum.cost;
        }
        const Bvh split = buildBinnedOver(std::move(references), all.bounds, options_.costs);
        double splitCost = all.cost;
        for (size_t i = 0; i < split.nodes.size(); ++i)
            if (i != 1 && !split.nodes[i].isLeaf())
                splitCost += options_.costs.traversal * halfArea(split.nodes[i].bounds);
        joinUntil(1);
        if (!(splitCost < tree_.cost(clusters_[0]))) return;
        pairCount_ = firstPair;
        joinAs(split, lower);
    }

    /// Joins clusters as a tree over them tells, level by level from the deepest up.
    void joinAs(const Bvh& split, const Buffer<Reference>& lower) {
        const size_t slots = split.nodes.size();
        std::vector<std::vector<uint32_t>> levels;  // inner nodes
        std::vector<uint8_t> depths(slots);
        for (uint32_t i = 0; i < slots; ++i) {
            const Node& node = split.nodes[i];
            if (i == 1 || node.isLeaf()) continue;
            depths[node.left()] = depths[node.right()] = uint8_t(depths[i] + 1);
            if (levels.size() <= depths[i]) levels.resize(depths[i] + size_t(1));
            levels[depths[i]].push_back(i);
        }
        Buffer<Reference> above(slots);
        const auto clusterOf = [&](uint32_t node) -> const Reference& {
            return split.nodes[node].isLeaf() ? lower[split.primitives[split.nodes[node].first]]
                                              : above[node];
        };
        for (; !levels.empty(); levels.pop_back()) {
            const std::vector<uint32_t>& level = levels.back();
            tree_.startRound(pairCount_);
            parallelChunks(level.size(), kGrain, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) {
                    const Node& node = split.nodes[level[i]];
                    above[level[i]] =
                        tree_.join(pairCount_ + uint32_t(i), clusterOf(node.left()), clusterOf(node.right()));
                }
            });
            pairCount_ += uint32_t(level.size());
        }
        clusters_[0] = above[0];
    }

    const Scene& scene_;
    const BuildOptions& options_;
    MortonOrder order_;
    uint32_t count_;
    uint32_t pairCount_ = 0;
    MergedTree tree_;
    Buffer<Reference> clusters_, joined_;
    Buffer<uint8_t> nearest_;  // each cluster's partner, by number
};

}  // namespace

Bvh buildPloc(const Scene& scene, const BuildOptions& options) {
    return PlocBuild(scene, options).build();
}

}  // namespace bvhio
#endif
