#include "restructure/tree_editor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "tree/collapse.h"

namespace bvhio {
namespace {

constexpr size_t kNodesPerTask = 1 << 14;

/// Opens leaves.
class LeafOpening {
  public:
    LeafOpening(const Scene& scene, const Bvh& bvh, bool split, Node* nodes)
        : scene_(scene), primitives_(bvh.primitives), split_(split), nodes_(nodes) {}

    /// Opens a leaf: writes a tree over its references to the pairs from `pair` on.
    void open(uint32_t index, uint32_t pair) {
        const Node leaf = nodes_[index];
        references_.clear();
        for (uint32_t i = leaf.first; i < leaf.first + leaf.primitiveCount; ++i) {
            Aabb box = bounds(scene_.triangle(primitives_[i]));
            // The part of a split triangle inside the leaf.
            if (split_) box = {max(box.min, leaf.bounds.min), min(box.max, leaf.bounds.max)};
            references_.push_back({box, i, 1});
        }
        next_ = pair;
        nodes_[index] = build(references_);
        // Keep the leaf's box, which a builder may have rounded outwards, or a refit may have kept wide.
        nodes_[index].bounds = leaf.bounds;
    }

  private:
    Node build(std::span<Node> references) {
        if (references.size() == 1) return references[0];
        const size_t half = split(references);
        const uint32_t pair = next_;
        next_ += 2;
        nodes_[pair] = build(references.first(half));
        nodes_[pair + 1] = build(references.subspan(half));
        return {unite(nodes_[pair].bounds, nodes_[pair + 1].bounds), pair, 0};
    }

    /// Sorts references along the axis in which their centroids lie furthest apart, and returns the place of
    /// the split with the least SAH cost. For many references, returns the middle, which limits the depth.
    size_t split(std::span<Node> references) {
        Aabb centers = Aabb::empty();
        for (const Node& reference : references) centers.extend(reference.bounds.center());
        const int axis = centers.longestAxis();
        std::sort(references.begin(), references.end(), [axis](const Node& a, const Node& b) {
            const float x = a.bounds.center()[axis], y = b.bounds.center()[axis];
            return x != y ? x < y : a.first < b.first;
        });
        const size_t count = references.size();
        if (count > kSweepUpTo) return count / 2;
        double rightCosts[kSweepUpTo];
        Aabb box = Aabb::empty();
        for (size_t i = count; i-- > 1;) {
            box.extend(references[i].bounds);
            rightCosts[i] = halfArea(box) * double(count - i);
        }
        box = Aabb::empty();
        size_t best = count / 2;
        double bestCost = std::numeric_limits<double>::infinity();
        for (size_t i = 1; i < count; ++i) {
            box.extend(references[i - 1].bounds);
            const double cost = halfArea(box) * double(i) + rightCosts[i];
            if (cost < bestCost) {
                bestCost = cost;
                best = i;
            }
        }
        return best;
    }

    static constexpr size_t kSweepUpTo = 16;
    const Scene& scene_;
    const std::span<const uint32_t> primitives_;
    const bool split_;
    Node* const nodes_;
    std::vector<Node> references_;
    uint32_t next_ = 0;
};

}  // namespace

TreeEditor::TreeEditor(const Scene& scene, const Bvh& bvh, const RestructureOptions& options, Links links)
    : given_(bvh), options_(options), primitives_(bvh.primitives) {
    maxLeafSize_ = options.maxLeafSize;
    if (maxLeafSize_ == 0) {
        maxLeafSize_ = 4;
        for (const Node& node : bvh.nodes) maxLeafSize_ = std::max(maxLeafSize_, node.primitiveCount);
    }
    if (options.collapse) {
        open(scene);
    } else {
        nodes_ = Buffer<Node>(bvh.nodes.size());
        std::copy(bvh.nodes.begin(), bvh.nodes.end(), nodes_.data());
    }
    if (links == Links::none) return;
    parentOfPair_ = Buffer<uint32_t>(nodes_.size() / 2);
    parentOfPair_[0] = 0;
    parallelChunks(nodes_.size(), kNodesPerTask, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            if (i != 1) adopt(uint32_t(i));
    });
}

/// Opens all leaves. Their new pairs come after all the given pairs, in the order of the leaves.
void TreeEditor::open(const Scene& scene) {
    const size_t given = given_.nodes.size();
    // A leaf of n references needs n - 1 pairs. The pairs of a chunk's leaves begin where those of the chunk
    // before end.
    std::vector<uint64_t> ends((given + kNodesPerTask - 1) / kNodesPerTask);
    parallelChunks(given, kNodesPerTask, [&](size_t begin, size_t end) {
        uint64_t pairs = 0;
        for (size_t i = begin; i < end; ++i)
            if (given_.nodes[i].isLeaf()) pairs += given_.nodes[i].primitiveCount - 1;
        ends[begin / kNodesPerTask] = pairs;
    });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    if (given + 2 * ends.back() > 0xFFFFFFFE)
        throw Error(ErrorKind::resources,
                    "there are too many references to open all leaves: use --no-collapse");
    nodes_ = Buffer<Node>(given + 2 * ends.back());
    std::copy(given_.nodes.begin(), given_.nodes.end(), nodes_.data());
    parallelChunks(given, kNodesPerTask, [&](size_t begin, size_t end) {
        LeafOpening opening(scene, given_, given_.primitives.size() > scene.triangles.size(), nodes_.data());
        uint64_t pair = given + (begin == 0 ? 0 : 2 * ends[begin / kNodesPerTask - 1]);
        for (size_t i = begin; i < end; ++i) {
            const uint32_t count = given_.nodes[i].primitiveCount;
            if (count < 2) continue;
            opening.open(uint32_t(i), uint32_t(pair));
            pair += 2 * (count - 1);
        }
    });
}

size_t TreeEditor::bytes() const {
    return nodes_.size() * sizeof(Node) + parentOfPair_.size() * sizeof(uint32_t);
}

void TreeEditor::endIteration(uint64_t changes) {
    const auto end = Clock::now();
    double cost = 0;
    if (options_.recordCosts) {
        const LooseTree tree{{nodes_.data(), nodes_.size()}, primitives_};
        cost = options_.collapse ? collapsedCost(tree, options_.costs, maxLeafSize_)
                                 : sahCost(depthFirst(tree), options_.costs);
    }
    iterations_.push_back({cost, std::chrono::duration<double>(end - iterationStart_).count(), changes});
    iterationStart_ = Clock::now();
    recordingSeconds_ += std::chrono::duration<double>(iterationStart_ - end).count();
}

Restructured TreeEditor::finish(size_t workBytes) && {
    const LooseTree tree{{nodes_.data(), nodes_.size()}, primitives_};
    double givenCost = 0;
    TaskGroup beside;
    beside.run([&] { givenCost = sahCost(given_, options_.costs); });
    Bvh bvh = options_.collapse ? collapse(tree, options_.costs, maxLeafSize_) : depthFirst(tree);
    beside.wait();
    if (!(sahCost(bvh, options_.costs) < givenCost)) bvh = given_;
    const double nodes = double(nodes_.size() - 1);
    return {std::move(bvh), std::move(iterations_), double(bytes() + workBytes) / nodes, recordingSeconds_};
}

float extentScale(const Aabb& root) {
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, double(root.max[axis]) - root.min[axis]);
    if (extent == 0) return 1;
    return std::ldexp(1.0f, std::clamp(-std::ilogb(extent), -126, 127));
}

}  // namespace bvhio
