// The common part of top-down builders: references to primitives, parallel tasks, the limit on depth, the
// leaf rule, and the final node array. A builder only provides its split.
#pragma once

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "build/builders.h"
#include "build/reference.h"
#include "build/small_tree.h"
#include "core/buffer.h"
#include "core/parallel.h"

namespace bvhio {

/// A future node: a run of references, and its position in the tree.
struct Range {
    Box bounds;
    uint32_t begin = 0, count = 0;
    uint32_t place = 0, capacity = 0;  // the run is in [place, place + capacity), with room for splits to add
    float demand = 0;                  // the share of its parent's room that it should get
    uint32_t depth = 0;
    uint32_t side = 0;  // the one of the two reference arrays that holds the run now
};

/// Two arrays of references. A split moves a run from one array to the same place in the other, the left side
/// to the start and the right side to the end, and keeps the order within each side. So a split streams
/// through memory and can work in chunks, and its result depends only on the input.
struct ReferenceArrays {
    Reference* sides[2];

    size_t stride = 0;  // from one order to the next, for splitters that keep several

    Reference* at(const Range& range, uint32_t order = 0) const {
        return sides[range.side] + order * stride + range.begin;
    }
    /// Return the places to which a split moves the left side, and a right side of `rightCount`.
    Reference* left(const Range& range, uint32_t order = 0) const {
        return sides[range.side ^ 1] + order * stride + range.place;
    }
    Reference* right(const Range& range, uint32_t rightCount, uint32_t order = 0) const {
        return left(range, order) + (range.capacity - rightCount);
    }
};

/// Returns whether a node may be split anywhere. If not, it must be halved, so that the leaves stay within
/// kMaxDepth even if every split so far took off a single primitive.
inline bool mayChooseSplit(const Range& range) {
    return range.depth + 1 + std::bit_width(range.count - 2) <=
           kMaxDepth;  // bit_width(n - 1) = log2 of n, rounded up
}

/// Halves a range by centroid along the longest axis of the box of its centroids, ties by primitive. If all
/// centroids coincide, halves it by position. Each side gets half of the references, whatever their
/// coordinates.
void splitAtMedian(const ReferenceArrays& references, const Range& range, Range& left, Range& right);

/// A part of the tree: a split above the tasks, or a subtree that one task built.
struct TreePart {
    // A split: the sibling pair below it.
    Node nodes[2];
    std::unique_ptr<TreePart> children[2];
    // A subtree: the place of its references, the number of nodes below its root, and the number of entries
    // of its leaves.
    uint32_t place = 0, capacity = 0, nodeCount = 0, primitiveCount = 0;

    bool isSubtree() const { return !children[0]; }
};

/// Stores the nodes of a finished subtree in the place of its references. A tree over n leaves has at most 2
/// n - 2 nodes below its root, so the n slots of the two arrays have space for them.
void keepNodes(const ReferenceArrays& references, const TreePart& subtree, const Node* nodes);

/// Joins the parts into the canonical, depth-first tree. The primitives of each subtree are in `primitives`,
/// at the place of its references; its leaves count from there.
Bvh gather(const ReferenceArrays& references, const Node& root, const TreePart& parts,
           Buffer<uint32_t> primitives);

/// Builds trees from the root down. `Splitter` provides
///
///     bool split(const ReferenceArrays&, const Range&, Range& left, Range& right, bool parallel) const;
///
/// which moves the references of both sides to the opposite array, fills in the bounds and counts of `left`
/// and `right` (each at least 1), and may use all threads if `parallel` is set. If it finds no split it
/// returns false, and the range is halved. It is called from several threads at once. If the range's capacity
/// has room, a triangle may have a part on both sides, as long as neither side gets as many references as the
/// range; `split` then sets the demands of the sides for the rest of the room.
///
/// A splitter may keep the references in several orders, one after another in the arrays. It then provides
///
///     static constexpr uint32_t kOrders;
///     void makeOrders(const ReferenceArrays&, Range&);
///     void halve(const ReferenceArrays&, const Range&, Range& left, Range& right, bool parallel) const;
///
/// where `makeOrders` gets the references of all triangles in order 0 and writes all orders to the opposite
/// array, and `halve` does for all orders what splitAtMedian does for a single one.
template <class Splitter>
class TopDownBuild {
  public:
    /// `room` is the number of references that splits may add.
    TopDownBuild(const BuildOptions& options, Splitter& splitter, uint32_t room = 0)
        : leafRule_{options.costs.traversal, options.costs.intersection, std::max(options.maxLeafSize, 1u)},
          splitter_(splitter),
          progress_(options.progress),
          room_(room) {}

    /// Builds the tree over a scene's triangles.
    Bvh build(const Scene& scene) && {
        const auto count = uint32_t(scene.triangles.size());
        if (progress_) progress_->start(count);
        Buffer<Reference> references;
        Box bounds;
        const size_t places = (size_t(count) + room_) * kOrders;
        const bool rescaled = makeReferences(scene, references, bounds, places - count);
        // Boxes that are scaled, unlike their triangles, cannot be split; and refitting would undo splits.
        if (rescaled) room_ = 0;
        Bvh bvh = std::move(*this).build(std::move(references), count, bounds);
        if (rescaled) bvh.nodes = refitted(scene, bvh);
        return bvh;
    }

    /// Builds the tree over the first `count` references, whose bounds are `bounds`. Its primitives are those
    /// of the references. The array has places for all orders, with room.
    Bvh build(Buffer<Reference> references, uint32_t count, const Box& bounds) && {
        Range range;
        range.bounds = bounds;
        range.count = count;
        range.capacity = count + room_;
        Buffer<Reference> opposite(references.size());
        references_ = {{references.data(), opposite.data()}, range.capacity};
        if constexpr (kOrders > 1) {
            splitter_.makeOrders(references_, range);
            range.side = 1;
        }
        primitives_ = Buffer<uint32_t>(range.capacity);

        Node root;
        TreePart parts;
        buildPart(range, root, parts);
        return gather(references_, root, parts, std::move(primitives_));
    }

  private:
    static constexpr uint32_t kOrders = [] {
        if constexpr (requires { Splitter::kOrders; })
            return Splitter::kOrders;
        else
            return 1u;
    }();
    static constexpr uint32_t kSharedSplit = 1u << 16;  // from this size, all threads work on one split
    static constexpr uint32_t kTask = 1u << 12;         // up to this size, one task builds the whole subtree

    /// Builds a part of the tree, by tasks.
    void buildPart(const Range& range, Node& node, TreePart& part) {
        if (range.count <= std::max(kTask, leafRule_.maxLeafSize)) return buildSubtree(range, node, part);
        Range sides[2];
        split(references_, range, sides[0], sides[1], range.count >= kSharedSplit);
        if (progress_) progress_->total += sides[0].count + sides[1].count - range.count;
        node = {range.bounds.toAabb(), 0, 0};
        for (auto& child : part.children) child = std::make_unique<TreePart>();
        TaskGroup group;
        group.run([&] { buildPart(sides[0], part.nodes[0], *part.children[0]); });
        buildPart(sides[1], part.nodes[1], *part.children[1]);
        group.wait();
    }

    /// The data with which one task builds a subtree, close together so that it stays in the cache of one
    /// core.
    struct Workspace {
        ReferenceArrays references;
        Node* nodes;  // pairs, depth first
        uint32_t nodeCount;
        uint32_t* primitives;
        uint32_t primitiveCount;
    };

    /// Builds a subtree in one task: copies its references to a workspace, and keeps the resulting nodes.
    void buildSubtree(const Range& range, Node& node, TreePart& part) {
        const size_t places = size_t(range.capacity) * kOrders;
        Buffer<Reference> references(places * 2);
        Buffer<Node> nodes(size_t(range.capacity) * 2);
        for (uint32_t order = 0; order < kOrders; ++order)
            std::copy_n(references_.at(range, order), range.count,
                        references.data() + order * size_t(range.capacity));
        Workspace work{{{references.data(), references.data() + places}, range.capacity},
                       nodes.data(),
                       0,
                       primitives_.data() + range.place,
                       0};
        Range local = range;
        local.begin = local.place = local.side = 0;
        grow(work, local, node);
        part.place = range.place;
        part.capacity = range.capacity;
        part.nodeCount = work.nodeCount;
        part.primitiveCount = work.primitiveCount;
        keepNodes(references_, part, nodes.data());
        if (progress_) progress_->add(range.count);
    }

    /// Builds the subtree of a range, or a single leaf if that costs no more. Returns its SAH cost, not
    /// divided by the root's area.
    float grow(Workspace& work, const Range& range, Node& node) {
        if (range.count <= kSmallTree && range.depth + range.count <= kMaxDepth + 1) {
            const uint32_t begin = work.primitiveCount;
            work.primitiveCount += range.count;
            return buildSmallTree(work.references.at(range), range.count, leafRule_, node, work.nodes,
                                  work.nodeCount, work.primitives, begin);
        }

        // Split the range, and build both sides.
        Range left, right;
        split(work.references, range, left, right, false);
        const float area = range.bounds.halfArea();
        const uint32_t pair = work.nodeCount, firstPrimitive = work.primitiveCount;
        work.nodeCount += 2;
        float cost = leafRule_.traversal * area;
        cost += grow(work, left, work.nodes[pair]);
        // The right side gets the room that the left side did not use.
        const uint32_t unused = left.capacity - (work.primitiveCount - firstPrimitive);
        right.place -= unused;
        right.capacity += unused;
        cost += grow(work, right, work.nodes[pair + 1]);
        node = {range.bounds.toAabb(), pair, 0};

        // Replace the subtree by a leaf if that costs no more.
        if (range.count > leafRule_.maxLeafSize) return cost;
        const float leafCost = leafRule_.cost(area, range.count);
        if (!(leafCost <= cost)) return cost;
        work.nodeCount = pair;
        if (work.primitiveCount - firstPrimitive > range.count) {
            // Keep each triangle once, where several of its parts meet again.
            uint32_t* const begin = work.primitives + firstPrimitive;
            std::sort(begin, work.primitives + work.primitiveCount);
            std::unique(begin, work.primitives + work.primitiveCount);
        }
        work.primitiveCount = firstPrimitive + range.count;
        node.first = firstPrimitive;
        node.primitiveCount = range.count;
        return leafCost;
    }

    /// Splits or halves a range, and gives the sides their places.
    void split(const ReferenceArrays& references, const Range& range, Range& left, Range& right,
               bool parallel) const {
        if (!mayChooseSplit(range) || !splitter_.split(references, range, left, right, parallel)) {
            if constexpr (kOrders > 1)
                splitter_.halve(references, range, left, right, parallel);
            else
                splitAtMedian(references, range, left, right);
        }
        left.begin = left.place = range.place;
        left.capacity = left.count + shareOfRoom(range, left, right);
        right.place = range.place + left.capacity;
        right.capacity = range.capacity - left.capacity;
        right.begin = range.place + range.capacity - right.count;
        left.depth = right.depth = range.depth + 1;
        left.side = right.side = range.side ^ 1;
    }

    /// Returns the left side's share of the room that a split leaves.
    static uint32_t shareOfRoom(const Range& range, const Range& left, const Range& right) {
        const uint32_t room = range.capacity - left.count - right.count;
        if (room == 0) return 0;
        const float both = left.demand + right.demand;
        const double share =
            both > 0 ? double(left.demand) / both : double(left.count) / (double(left.count) + right.count);
        return uint32_t(room * std::min(share, 1.0));
    }

    const LeafRule leafRule_;
    Splitter& splitter_;
    Progress* const progress_;
    uint32_t room_;
    Buffer<uint32_t> primitives_;
    ReferenceArrays references_{};
};

}  // namespace bvhio
