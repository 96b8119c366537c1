// What top-down builders share: references to primitives, who builds which range in parallel, the bound on
// depth, the leaf rule, and the final node array. A builder brings only its split.
#pragma once

#include <bit>
#include <memory>
#include <vector>

#include "build/builders.h"
#include "build/reference.h"
#include "build/small_tree.h"
#include "core/buffer.h"
#include "core/parallel.h"

namespace bvhio {

/// A node to be: a run of references, and where it stands in the tree.
struct Range {
    Box bounds;     // of the references' boxes
    Box centroids;  // of their centroids, doubled
    uint32_t begin = 0, count = 0;
    uint32_t depth = 0;
    uint32_t side = 0;  // which of the two reference arrays holds the run now
};

/// Two arrays of references: a split moves a run from one to the same place in the other, keeping the order
/// within each half. So a split streams, can be done in chunks, and its result depends on the input alone.
struct ReferenceArrays {
    Buffer<Reference> sides[2];
    Reference* at(const Range& range) { return sides[range.side].data() + range.begin; }
    Reference* opposite(const Range& range) { return sides[range.side ^ 1].data() + range.begin; }
};

/// True when a node may be split anywhere; otherwise it must be halved, so that the leaves stay within
/// kMaxDepth even if every split so far took off a single primitive.
inline bool mayChooseSplit(const Range& range) {
    return range.depth + 1 + std::bit_width(range.count - 2) <=
           kMaxDepth;  // bit_width(n - 1) = log2 of n, rounded up
}

/// Halves a range by centroid along the longest axis of its centroids' box, ties by primitive; when all
/// centroids coincide, by position. Each side gets half of the references whatever their coordinates.
void splitAtMedian(ReferenceArrays& references, const Range& range, Range& left, Range& right);

/// Final nodes of ranges, before they are gathered depth first. The nodes below a range of n references have
/// slots [2 * begin, 2 * (begin + n) - 2) to themselves, since a binary tree over n leaves has n - 1 sibling
/// pairs: so tasks need no shared counter, and what a task writes does not depend on the others.
struct Slots {
    Node* nodes;
    uint32_t next, begin;

    uint32_t takePair() {
        const uint32_t pair = next;
        next += 2;
        return pair;
    }
};

/// One part of the tree: a split done for all threads, or a subtree that one task built.
struct TreePart {
    Node nodes[2];  // the sibling pair below a shared split
    std::unique_ptr<TreePart> children[2];
    uint32_t firstSlot = 0, slotCount = 0;  // a subtree's pairs, depth first, in `Slots::nodes`
    bool isSubtree() const { return !children[0]; }
};

/// Joins the parts into the canonical, depth-first node array.
SharedArray<Node> gatherNodes(const Node& root, const TreePart& parts, const Buffer<Node>& slots);

/// Builds a tree from the root down. `Splitter` provides
///
///     bool split(ReferenceArrays&, const Range&, Range& left, Range& right, bool parallel);
///
/// which moves the references of both sides to the opposite array, fills in the bounds, centroids and counts
/// of `left` and `right` (each at least 1), and may use all threads when `parallel`; or returns false when it
/// finds no split, and the range is halved. It is called from several threads at once.
template <class Splitter>
class TopDownBuild {
  public:
    TopDownBuild(const Scene& scene, const BuildOptions& options, const Splitter& splitter)
        : splitter_(splitter),
          leafRule_{options.costs.traversal, options.costs.intersection, std::max(options.maxLeafSize, 1u)},
          count_(uint32_t(scene.triangles.size())),
          scene_(scene) {}

    Bvh build() {
        Range range;
        const bool rescaled = makeReferences(scene_, references_.sides[0], range.bounds, range.centroids);
        references_.sides[1] = Buffer<Reference>(count_);
        primitives_ = Buffer<uint32_t>(count_);
        slots_ = Buffer<Node>(size_t(count_) * 2);
        range.count = count_;

        Node root;
        TreePart parts;
        buildPart(range, root, parts);
        references_ = {};
        Bvh bvh{gatherNodes(root, parts, slots_), std::move(primitives_).share()};
        if (rescaled) bvh.nodes = refitted(scene_, bvh);
        return bvh;
    }

  private:
    static constexpr uint32_t kSharedSplit = 1u << 16;  // from here on all threads work on one split
    static constexpr uint32_t kTask = 1u << 12;         // up to here one task builds the whole subtree

    void buildPart(const Range& range, Node& node, TreePart& part) {
        if (range.count <= std::max(kTask, leafRule_.maxLeafSize)) {
            Slots slots{slots_.data(), range.begin * 2, range.begin * 2};
            buildSubtree(range, node, slots);
            part.firstSlot = slots.begin;
            part.slotCount = slots.next - slots.begin;
            return;
        }
        Range sides[2];
        split(range, sides[0], sides[1], range.count >= kSharedSplit);
        node = {range.bounds.toAabb(), 0, 0};
        for (auto& child : part.children) child = std::make_unique<TreePart>();
        TaskGroup group;
        group.run([&] { buildPart(sides[0], part.nodes[0], *part.children[0]); });
        buildPart(sides[1], part.nodes[1], *part.children[1]);
        group.wait();
    }

    /// Returns the subtree's SAH cost times areas; below, a subtree becomes one leaf where that costs no
    /// more.
    float buildSubtree(const Range& range, Node& node, Slots& slots) {
        if (range.count <= kSmallTree && range.depth + range.count <= kMaxDepth + 1)
            return buildSmallTree(references_.at(range), range.count, range.begin, leafRule_, node,
                                  slots.nodes, slots.next, primitives_.data());
        Range left, right;
        split(range, left, right, false);
        const float area = range.bounds.halfArea();
        const uint32_t pair = slots.takePair();
        const float cost = leafRule_.traversal * area + buildSubtree(left, slots.nodes[pair], slots) +
                           buildSubtree(right, slots.nodes[pair + 1], slots);
        node = {range.bounds.toAabb(), pair, 0};
        if (range.count > leafRule_.maxLeafSize) return cost;
        const float leafCost = leafRule_.cost(area, range.count);
        if (!(leafCost <= cost)) return cost;
        slots.next = pair;
        node.first = range.begin;
        node.primitiveCount = range.count;
        return leafCost;
    }

    void split(const Range& range, Range& left, Range& right, bool parallel) {
        if (!mayChooseSplit(range) || !splitter_.split(references_, range, left, right, parallel))
            splitAtMedian(references_, range, left, right);
        left.begin = range.begin;
        right.begin = range.begin + left.count;
        left.depth = right.depth = range.depth + 1;
        left.side = right.side = range.side ^ 1;
    }

    const Splitter& splitter_;
    const LeafRule leafRule_;
    const uint32_t count_;
    const Scene& scene_;
    ReferenceArrays references_;
    Buffer<uint32_t> primitives_;
    Buffer<Node> slots_;
};

}  // namespace bvhio
