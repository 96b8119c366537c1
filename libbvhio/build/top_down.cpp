#include "build/top_down.h"

#include <algorithm>
#include <cstring>

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
}

/// Places parts depth first.
class Gathering {
  public:
    Gathering(const ReferenceArrays& references, Buffer<Node>& nodes)
        : references_(references), nodes_(nodes) {}

    /// Places the nodes below `node`, which has its final place, at `next_` and on.
    void place(const TreePart& part, Node& node) {
        const uint32_t to = next_;
        if (part.isSubtree()) {
            if (!node.isLeaf()) node.first += to;
            subtrees_.push_back({&part, to});
            next_ += part.nodeCount;
            return;
        }
        node.first = to;
        next_ += 2;
        for (int side = 0; side < 2; ++side) {
            nodes_[to + side] = part.nodes[side];
            place(*part.children[side], nodes_[to + side]);
        }
    }

    void copySubtrees() const {
        parallelChunks(subtrees_.size(), 4, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const auto& [part, to] = subtrees_[i];
                const uint32_t firstHalf = std::min(part->nodeCount, part->count);
                copy(references_.sides[0] + part->begin, firstHalf, to, nodes_.data() + to);
                copy(references_.sides[1] + part->begin, part->nodeCount - firstHalf, to,
                     nodes_.data() + to + firstHalf);
            }
        });
    }

  private:
    /// Children are counted from the start of the subtree's nodes, which is now at `start`.
    static void copy(const Reference* kept, uint32_t count, uint32_t start, Node* nodes) {
        for (uint32_t i = 0; i < count; ++i) {
            std::memcpy(static_cast<void*>(nodes + i), kept + i, sizeof(Node));
            if (!nodes[i].isLeaf()) nodes[i].first += start;
        }
    }

    const ReferenceArrays& references_;
    Buffer<Node>& nodes_;
    std::vector<std::pair<const TreePart*, uint32_t>> subtrees_;  // and where their nodes go
    uint32_t next_ = 2;
};

uint32_t nodesBelow(const TreePart& part) {
    return part.isSubtree() ? part.nodeCount
                            : 2 + nodesBelow(*part.children[0]) + nodesBelow(*part.children[1]);
}

}  // namespace

void splitAtMedian(const ReferenceArrays& references, const Range& range, Range& left, Range& right) {
    const Reference* source = references.at(range);
    Reference* target = references.opposite(range);
    const uint32_t half = range.count / 2;
    left.bounds = right.bounds = Box::empty();
    left.count = right.count = 0;
    const Box centroids = centroidBounds(source, range.count);
    const int axis = centroids.longestAxis();

    if (centroids.extent(axis) > 0) {
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

void keepNodes(const ReferenceArrays& references, const TreePart& subtree, const Node* nodes) {
    static_assert(sizeof(Node) == sizeof(Reference));
    const uint32_t firstHalf = std::min(subtree.nodeCount, subtree.count);
    std::memcpy(static_cast<void*>(references.sides[0] + subtree.begin), nodes, firstHalf * sizeof(Node));
    std::memcpy(static_cast<void*>(references.sides[1] + subtree.begin), nodes + firstHalf,
                (subtree.nodeCount - firstHalf) * sizeof(Node));
}

SharedArray<Node> gatherNodes(const ReferenceArrays& references, const Node& root, const TreePart& parts) {
    Buffer<Node> nodes(2 + nodesBelow(parts));
    nodes[0] = root;
    nodes[1] = {};
    Gathering gathering(references, nodes);
    gathering.place(parts, nodes[0]);
    gathering.copySubtrees();
    return std::move(nodes).share();
}

}  // namespace bvhio
