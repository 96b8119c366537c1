// LBVH (Lauterbach et al. 2009, "Fast BVH construction on GPUs"): triangles are in Morton order, and each
// node is split where the highest bit of the codes changes, as in the binary radix tree of Karras 2012
// ("Maximizing parallelism in the construction of BVHs, octrees, and k-d trees"). Karras' rule for equal
// codes is used too: their places distinguish them. Departures:
//
// - The SAH decides bottom-up which subtrees become leaves. It does not choose splits.
// - No hierarchy with pointers is made first. The order is cut into runs, and each run is a subtree whose
//   nodes are made in their final, depth-first order. The run is walked from right to left: a triangle's node
//   is merged with the subtree to its right as long as the next level to its left is higher in the tree. So
//   parents are made after their children, and a right sibling's nodes before the left sibling's. Read
//   backwards, that is depth first.

#include "build/lbvh.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "build/morton.h"
#include "build/small_tree.h"
#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/lbvh.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

#ifndef BVHIO_BUILD_LBVH_CPP
#define BVHIO_BUILD_LBVH_CPP
namespace bvhio {
namespace {

/// A part of the tree, over places [begin, end) of the Morton order: a subtree that one task builds, or a
/// single node above the subtrees. Parts are in depth-first order in their array, so the left child of a node
/// is the next part.
struct Part {
    uint32_t begin = 0, end = 0;
    uint32_t right = 0;  // the right child; 0 = this is a subtree
    Box bounds;
    Node root{};
    uint32_t nodeCount = 2;  // below the root
    uint32_t firstNode = 0;  // the place of these nodes in the whole tree
};

}  // namespace
}  // namespace bvhio
#endif

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Builds one subtree. The pairs below its root end up at the end of a buffer, depth first.
class Growth {
  public:
    Growth(const Scene& scene, const MortonOrder& order, const LeafRule& rule)
        : triangles_(scene.triangles.data()), boxes_(scene, order.scale), order_(order), rule_(rule) {}

    void grow(Part& part, Buffer<Node>& nodes) {
        const size_t most = size_t(part.end - part.begin) * 2;
        if (nodes.size() < most) nodes = Buffer<Node>(most);
        nodes_ = nodes.data();
        freeSlots_ = uint32_t(nodes.size());
        depth_ = 0;
        levels_[0] = 0;  // less than all levels, so that nothing merges with an empty stack
        for (uint32_t end = part.end; end != part.begin;) {
            const uint32_t begin = end - std::min(end - part.begin, kBlock);
            push(begin, end, part.begin);
            end = begin;
        }
        const Subtree& root = stack_[depth_];
        std::memcpy(part.bounds.negatedMin, root.box, sizeof root.box);
        part.root = root.node();
        part.nodeCount = uint32_t(nodes.size()) - freeSlots_;
    }

  private:
    static constexpr uint32_t kBlock = 64;

    /// A finished subtree on the stack. Its places come before those of the subtree below it on the stack.
    struct alignas(32) Subtree {
        float box[8];
        float cost;                // SAH cost, not divided by the root's area
        uint32_t first, leafSize;  // as Node's first and primitiveCount
        uint32_t count;
        uint32_t slotsBefore;  // free slots before its nodes were placed

        Node node() const {
            return {{{0 - box[0], 0 - box[1], 0 - box[2]}, {box[4], box[5], box[6]}}, first, leafSize};
        }
    };

    /// Returns the place `blocks` blocks before `place`, but at least `first`.
    static uint32_t ahead(uint32_t place, uint32_t first, uint32_t blocks) {
        return place - std::min(place - first, blocks * kBlock);
    }

    /// Pushes the triangles of places [begin, end) as leaves, from right to left, and merges what they
    /// complete.
    void push(uint32_t begin, uint32_t end, uint32_t first) {
        alignas(32) float boxes[kBlock][8];
        // The triangles and their vertices are anywhere in memory: prefetch those of the next blocks.
        for (uint32_t i = ahead(begin, first, 2); i < ahead(end, first, 2); ++i)
            hwy::Prefetch(&triangles_[order_.triangles[i]]);
        for (uint32_t i = ahead(begin, first, 1); i < ahead(end, first, 1); ++i)
            boxes_.prefetch(triangles_[order_.triangles[i]]);
        for (uint32_t i = begin; i < end; ++i)
            boxes_(triangles_[order_.triangles[i]]).store(boxes[i - begin]);
        for (uint32_t i = end; i-- > begin;) {
            const BoxV box = BoxV::load(boxes[i - begin]);
            Subtree& leaf = stack_[++depth_];
            box.store(leaf.box);
            leaf.cost = rule_.cost(halfArea(box), 1);
            leaf.first = i;
            leaf.leafSize = leaf.count = 1;
            leaf.slotsBefore = freeSlots_;
            const uint32_t level = i == first ? 0 : 1 + order_.levels[i - 1];
            while (levels_[depth_ - 1] > level) merge(i);
            levels_[depth_] = level;
        }
    }

    /// Merges the two topmost subtrees. The left one begins at place `begin`.
    void merge(uint32_t begin) {
        Subtree &left = stack_[depth_], &right = stack_[depth_ - 1];
        const BoxV box = unite(BoxV::load(left.box), BoxV::load(right.box));
        const float area = halfArea(box);
        const uint32_t count = left.count + right.count;
        const float cost = rule_.traversal * area + left.cost + right.cost,
                    leafCost = rule_.cost(area, count);
        if (count <= rule_.maxLeafSize && leafCost <= cost) {
            freeSlots_ = right.slotsBefore;
            right.first = begin;
            right.leafSize = count;
            right.cost = leafCost;
        } else {
            freeSlots_ -= 2;
            nodes_[freeSlots_] = left.node();
            nodes_[freeSlots_ + 1] = right.node();
            right.first = freeSlots_;
            right.leafSize = 0;
            right.cost = cost;
        }
        box.store(right.box);
        right.count = count;
        --depth_;
    }

    static HWY_INLINE float halfArea(BoxV box) {
        alignas(16) float extents[4];
        hn::Store(hn::Add(box.low(), box.high()), Four(), extents);
        return extents[0] * extents[1] + extents[1] * extents[2] + extents[2] * extents[0];
    }

    const TriangleIndices* triangles_;
    TriangleBoxes boxes_;
    const MortonOrder& order_;
    const LeafRule& rule_;
    Node* nodes_ = nullptr;
    uint32_t freeSlots_ = 0;
    uint32_t depth_ = 0;
    Subtree stack_[kMaxDepth + 2];
    uint32_t levels_[kMaxDepth + 2];  // the level to the left of each subtree
};

void growPart(const Scene& scene, const MortonOrder& order, const LeafRule& rule, Part& part,
              Buffer<Node>& nodes) {
    Growth(scene, order, rule).grow(part, nodes);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(growPart);

class LbvhBuild {
  public:
    LbvhBuild(const Scene& scene, const BuildOptions& options)
        : scene_(scene),
          rule_{options.costs.traversal, options.costs.intersection, std::max(options.maxLeafSize, 1u)},
          progress_(options.progress),
          order_(mortonOrder(scene)) {}

    Bvh build() && {
        const auto count = uint32_t(scene_.triangles.size());
        if (progress_) progress_->start(count);
        cut(0, count);
        nodes_ = Buffer<Node>(size_t(count) * 2);
        nodes_[1] = {};
        parallelInOrder<Buffer<Node>>(
            subtrees_.size(),
            [&](size_t i, Buffer<Node>& nodes) {
                HWY_DYNAMIC_DISPATCH(growPart)(scene_, order_, rule_, parts_[subtrees_[i]], nodes);
            },
            [&](size_t i) { place(subtrees_[i]); },
            [&](size_t i, const Buffer<Node>& nodes) { copy(parts_[subtrees_[i]], nodes); });
        for (size_t i = parts_.size(); i-- > 0;)
            if (parts_[i].right != 0) join(parts_[i], parts_[i + 1], parts_[parts_[i].right]);
        nodes_[0] = parts_[0].root;
        nodes_.truncate(nodeCount_);
        Bvh bvh{std::move(nodes_).share(), std::move(order_.triangles).share()};
        if (order_.scale != 1) bvh.nodes = refitted(scene_, bvh);
        return bvh;
    }

  private:
    static constexpr uint32_t kTask = 1u << 12;  // up to this size, one task builds the whole subtree

    /// Divides places [begin, end) into subtrees and the nodes above them, where the level is lowest.
    void cut(uint32_t begin, uint32_t end) {
        const size_t part = parts_.size();
        Part& added = parts_.emplace_back();
        added.begin = begin;
        added.end = end;
        if (end - begin <= std::max(kTask, rule_.maxLeafSize)) return subtrees_.push_back(part);
        const uint8_t *const first = order_.levels.data() + begin, *const last = first + (end - 1 - begin);
        uint8_t lowest = 255;
        for (const uint8_t* level = first; level != last; ++level) lowest = std::min(lowest, *level);
        const void* const found = std::memchr(first, lowest, size_t(last - first));
        const auto middle = begin + 1 + uint32_t(static_cast<const uint8_t*>(found) - first);
        cut(begin, middle);
        parts_[part].right = uint32_t(parts_.size());
        cut(middle, end);
    }

    /// Assigns places to the nodes of a subtree, and to all nodes before them that have no places yet.
    void place(size_t subtree) {
        for (; placed_ <= subtree; ++placed_) {
            parts_[placed_].firstNode = nodeCount_;
            nodeCount_ += parts_[placed_].nodeCount;
        }
    }

    /// Copies the nodes of a subtree to their places in the whole tree.
    void copy(Part& part, const Buffer<Node>& nodes) {
        const auto unused = uint32_t(nodes.size()) - part.nodeCount;
        const Node* from = nodes.data() + unused;
        Node* to = nodes_.data() + part.firstNode;
        const uint32_t shift = part.firstNode - unused;
        for (uint32_t i = 0; i < part.nodeCount; ++i) {
            Node node = from[i];
            node.first += node.isLeaf() ? 0 : shift;
            to[i] = node;
        }
        if (!part.root.isLeaf()) part.root.first += shift;
        if (progress_) progress_->add(part.end - part.begin);
    }

    void join(Part& part, const Part& left, const Part& right) {
        nodes_[part.firstNode] = left.root;
        nodes_[part.firstNode + 1] = right.root;
        part.bounds = left.bounds;
        part.bounds.extend(right.bounds);
        part.root = {part.bounds.toAabb(), part.firstNode, 0};
    }

    const Scene& scene_;
    const LeafRule rule_;
    Progress* const progress_;
    MortonOrder order_;
    std::vector<Part> parts_;
    std::vector<size_t> subtrees_;
    Buffer<Node> nodes_;
    uint32_t nodeCount_ = 2;
    size_t placed_ = 0;
};

}  // namespace

Bvh buildLbvh(const Scene& scene, const BuildOptions& options) {
    return LbvhBuild(scene, options).build();
}

}  // namespace bvhio
#endif
