#include "build/top_down.h"

#include <algorithm>

namespace bvhio {
namespace {

/// Orders references by centroid along an axis; no two are equal.
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
    const float centroid[3] = {reference.centroid(0), reference.centroid(1), reference.centroid(2)};
    range.centroids.extendPoint(centroid);
}

/// Copies a subtree's pairs, depth first already, to their final place.
struct Move {
    uint32_t from, to, count;
};

class Gathering {
  public:
    Gathering(const Buffer<Node>& slots, Buffer<Node>& nodes) : slots_(slots), nodes_(nodes) {}

    /// Places the nodes below `node`, which is in its final place, at `next_` and on.
    void place(const TreePart& part, Node& node) {
        const uint32_t to = next_;
        if (part.isSubtree()) {
            if (!node.isLeaf()) node.first += to - part.firstSlot;
            if (part.slotCount > 0) moves_.push_back({part.firstSlot, to, part.slotCount});
            next_ += part.slotCount;
            return;
        }
        node.first = to;
        next_ += 2;
        for (int side = 0; side < 2; ++side) {
            nodes_[to + side] = part.nodes[side];
            place(*part.children[side], nodes_[to + side]);
        }
    }
    void moveSubtrees() const {
        parallelChunks(moves_.size(), 4, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const Move& move = moves_[i];
                for (uint32_t k = 0; k < move.count; ++k) {
                    Node& node = nodes_[move.to + k] = slots_[move.from + k];
                    if (!node.isLeaf()) node.first += move.to - move.from;
                }
            }
        });
    }

  private:
    const Buffer<Node>& slots_;
    Buffer<Node>& nodes_;
    std::vector<Move> moves_;
    uint32_t next_ = 2;
};

uint32_t slotsOf(const TreePart& part) {
    return part.isSubtree() ? part.slotCount : 2 + slotsOf(*part.children[0]) + slotsOf(*part.children[1]);
}

}  // namespace

void splitAtMedian(ReferenceArrays& references, const Range& range, Range& left, Range& right) {
    const Reference* source = references.at(range);
    Reference* target = references.opposite(range);
    const uint32_t half = range.count / 2;
    left = right = {Box::empty(), Box::empty()};
    const int axis = range.centroids.longestAxis();

    if (range.centroids.extent(axis) > 0) {
        std::vector<CentroidKey> keys(range.count);
        for (uint32_t i = 0; i < range.count; ++i) keys[i] = {source[i].centroid(axis), source[i].primitive};
        std::nth_element(keys.begin(), keys.begin() + half, keys.end());
        const CentroidKey first =
            keys[half];  // of the right half: keys differ, so the halves do not depend on the library
        for (uint32_t i = 0; i < range.count; ++i) {
            const bool isLeft = CentroidKey{source[i].centroid(axis), source[i].primitive} < first;
            Range& side = isLeft ? left : right;
            target[(isLeft ? 0 : half) + side.count++] = source[i];
            extend(side, source[i]);
        }
    } else {
        for (uint32_t i = 0; i < range.count; ++i) {
            target[i] = source[i];
            extend(i < half ? left : right, source[i]);
        }
        left.count = half;
        right.count = range.count - half;
    }
}

SharedArray<Node> gatherNodes(const Node& root, const TreePart& parts, const Buffer<Node>& slots) {
    Buffer<Node> nodes(2 + slotsOf(parts));
    nodes[0] = root;
    nodes[1] = {};
    Gathering gathering(slots, nodes);
    gathering.place(parts, nodes[0]);
    gathering.moveSubtrees();
    return std::move(nodes).share();
}

}  // namespace bvhio
