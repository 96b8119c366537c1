#include "build/top_down.h"

#include <algorithm>
#include <cstring>

namespace bvhio {
namespace {

/// Orders references by centroid along an axis, and then by primitive, so that no two keys are equal.
struct CentroidKey {
    float centroid;
    uint32_t primitive;
    bool operator<(const CentroidKey& other) const {
        return centroid != other.centroid ? centroid < other.centroid : primitive < other.primitive;
    }
};

void extend(Range& range, const Reference& reference) {
    range.bounds.extend({{reference.negatedMin[0], reference.negatedMin[1], reference.negatedMin[2], 0},
                         {reference.max[0], reference.max[1], reference.max[2], 0}});
}

/// Joins parts in depth-first order.
class Gathering {
  public:
    Gathering(const ReferenceArrays& references, Buffer<Node>& nodes)
        : references_(references), nodes_(nodes) {}

    /// Places the nodes below `node` from `nextNode_` on. `node` itself is in its final place.
    void place(const TreePart& part, Node& node) {
        const uint32_t to = nextNode_;
        if (part.isSubtree()) {
            node.first += node.isLeaf() ? nextPrimitive_ : to;
            subtrees_.push_back({&part, to, nextPrimitive_});
            nextNode_ += part.nodeCount;
            nextPrimitive_ += part.primitiveCount;
            return;
        }
        node.first = to;
        nextNode_ += 2;
        for (int side = 0; side < 2; ++side) {
            nodes_[to + side] = part.nodes[side];
            place(*part.children[side], nodes_[to + side]);
        }
    }

    void copyNodes() const {
        parallelChunks(subtrees_.size(), 4, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const Subtree& subtree = subtrees_[i];
                const TreePart& part = *subtree.part;
                const uint32_t firstHalf = std::min(part.nodeCount, part.capacity);
                Node* const to = nodes_.data() + subtree.node;
                copy(references_.sides[0] + part.place, firstHalf, subtree, to);
                copy(references_.sides[1] + part.place, part.nodeCount - firstHalf, subtree, to + firstHalf);
            }
        });
    }

    /// Returns the primitives without the gaps of unused capacity.
    Buffer<uint32_t> packed(Buffer<uint32_t> primitives) const {
        if (nextPrimitive_ == primitives.size()) return primitives;
        Buffer<uint32_t> all(nextPrimitive_);
        parallelChunks(subtrees_.size(), 4, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                std::copy_n(primitives.data() + subtrees_[i].part->place, subtrees_[i].part->primitiveCount,
                            all.data() + subtrees_[i].primitive);
        });
        return all;
    }

  private:
    /// A subtree, and the places of its nodes and primitives.
    struct Subtree {
        const TreePart* part;
        uint32_t node, primitive;
    };

    /// Copies nodes of a subtree. Their indices count from the start of the subtree's nodes and primitives.
    static void copy(const Reference* kept, uint32_t count, const Subtree& subtree, Node* nodes) {
        for (uint32_t i = 0; i < count; ++i) {
            std::memcpy(static_cast<void*>(nodes + i), kept + i, sizeof(Node));
            nodes[i].first += nodes[i].isLeaf() ? subtree.primitive : subtree.node;
        }
    }

    const ReferenceArrays& references_;
    Buffer<Node>& nodes_;
    std::vector<Subtree> subtrees_;
    uint32_t nextNode_ = 2, nextPrimitive_ = 0;
};

uint32_t nodesBelow(const TreePart& part) {
    return part.isSubtree() ? part.nodeCount
                            : 2 + nodesBelow(*part.children[0]) + nodesBelow(*part.children[1]);
}

}  // namespace

void splitAtMedian(const ReferenceArrays& references, const Range& range, Range& left, Range& right) {
    const Reference* source = references.at(range);
    const uint32_t half = range.count / 2;
    left.count = half;
    right.count = range.count - half;
    left.bounds = right.bounds = Box::empty();
    Reference* toLeftSide = references.left(range);
    Reference* toRightSide = references.right(range, right.count);
    const auto move = [&](const Reference& reference, bool toLeft) {
        *(toLeft ? toLeftSide : toRightSide)++ = reference;
        extend(toLeft ? left : right, reference);
    };
    const Box centroids = centroidBounds(source, range.count);
    const int axis = centroids.longestAxis();

    if (centroids.extent(axis) > 0) {
        std::vector<CentroidKey> keys(range.count);
        for (uint32_t i = 0; i < range.count; ++i) keys[i] = {source[i].centroid(axis), source[i].primitive};
        std::nth_element(keys.begin(), keys.begin() + half, keys.end());
        // The first key of the right half. All keys differ, so the halves do not depend on the library.
        const CentroidKey first = keys[half];
        for (uint32_t i = 0; i < range.count; ++i)
            move(source[i], CentroidKey{source[i].centroid(axis), source[i].primitive} < first);
    } else {
        for (uint32_t i = 0; i < range.count; ++i) move(source[i], i < half);
    }
}

void keepNodes(const ReferenceArrays& references, const TreePart& subtree, const Node* nodes) {
    static_assert(sizeof(Node) == sizeof(Reference));
    const uint32_t firstHalf = std::min(subtree.nodeCount, subtree.capacity);
    std::memcpy(static_cast<void*>(references.sides[0] + subtree.place), nodes, firstHalf * sizeof(Node));
    std::memcpy(static_cast<void*>(references.sides[1] + subtree.place), nodes + firstHalf,
                (subtree.nodeCount - firstHalf) * sizeof(Node));
}

Bvh gather(const ReferenceArrays& references, const Node& root, const TreePart& parts,
           Buffer<uint32_t> primitives) {
    Buffer<Node> nodes(2 + nodesBelow(parts));
    nodes[0] = root;
    nodes[1] = {};
    Gathering gathering(references, nodes);
    gathering.place(parts, nodes[0]);
    gathering.copyNodes();
    primitives = gathering.packed(std::move(primitives));
    return {std::move(nodes).share(), std::move(primitives).share()};
}

}  // namespace bvhio
