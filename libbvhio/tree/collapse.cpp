// Tasks walk the subtrees; each task writes its nodes in depth-first order into an array of its own. The few
// nodes above the subtrees are handled by one thread. A walk that goes deeper than kMaxDepth gives up; the
// tree is then balanced and walked again. That is rare, so only such trees pay for it.

#include "tree/collapse.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "core/buffer.h"
#include "core/parallel.h"
#include "tree/limit_depth.h"

namespace bvhio {
namespace {

struct Rule {
    SahCosts costs;
    uint32_t maxLeafSize;
    bool duplicates;  // whether a triangle may have several references
};

struct TooDeep {};

/// A subtree that was walked. Its indices of children and of leaves' ranges start at 0, in its own arrays.
struct Part {
    Node root;
    std::vector<Node> nodes;
    std::vector<uint32_t> primitives;
    double cost = 0;  // SAH cost, not yet divided by the root's area
};

class Walk {
  public:
    Walk(const LooseTree& tree, const std::optional<Rule>& rule, Part& part)
        : tree_(tree), rule_(rule), part_(part) {}

    /// Appends the subtree of a node to the part, and returns the subtree's cost.
    double walk(uint32_t index, uint32_t depth, Node& out) {
        if (depth > kMaxDepth) throw TooDeep();
        const Node& node = tree_.nodes[index];
        const auto firstPrimitive = uint32_t(part_.primitives.size());
        if (node.isLeaf()) {
            const auto range = tree_.primitives.subspan(node.first, node.primitiveCount);
            part_.primitives.insert(part_.primitives.end(), range.begin(), range.end());
            out = {node.bounds, firstPrimitive, node.primitiveCount};
            return rule_ ? rule_->costs.intersection * halfArea(node.bounds) * node.primitiveCount : 0;
        }
        // The right child's children may be far away in memory, and are needed later: prefetch them.
        const Node& next = tree_.nodes[node.right()];
        hwy::Prefetch(next.isLeaf() ? &next : &tree_.nodes[next.left()]);
        const auto pair = uint32_t(part_.nodes.size());
        part_.nodes.resize(pair + 2);
        Node left, right;
        double cost = walk(node.left(), depth + 1, left);
        cost += walk(node.right(), depth + 1, right);
        out = {node.bounds, pair, 0};
        if (rule_) {
            cost += rule_->costs.traversal * halfArea(node.bounds);
            if (becomesLeaf(firstPrimitive, cost, out)) {
                part_.nodes.resize(pair);
                return cost;
            }
        }
        part_.nodes[pair] = left;
        part_.nodes[pair + 1] = right;
        return cost;
    }

    /// Turns `node` into a leaf of all references from `first` on, if that costs no more than `cost`; if so,
    /// sets `cost` to the leaf's. Returns whether it did.
    bool becomesLeaf(uint32_t first, double& cost, Node& node) {
        const auto size = uint32_t(part_.primitives.size()) - first;
        uint32_t count = size;
        // With duplicates there may be fewer triangles than references, but hardly fewer than a quarter:
        // larger subtrees are not worth counting.
        if (size > rule_->maxLeafSize && (!rule_->duplicates || size / 4 > rule_->maxLeafSize)) return false;
        if (rule_->duplicates) {
            sorted_.assign(part_.primitives.begin() + first, part_.primitives.end());
            std::sort(sorted_.begin(), sorted_.end());
            sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
            count = uint32_t(sorted_.size());
            if (count > rule_->maxLeafSize) return false;
        }
        const double leafCost = rule_->costs.intersection * halfArea(node.bounds) * count;
        if (!(leafCost <= cost)) return false;
        if (count < size) {
            part_.primitives.resize(first);
            part_.primitives.insert(part_.primitives.end(), sorted_.begin(), sorted_.end());
        }
        cost = leafCost;
        node.first = first;
        node.primitiveCount = count;
        return true;
    }

  private:
    const LooseTree& tree_;
    const std::optional<Rule>& rule_;
    Part& part_;
    std::vector<uint32_t> sorted_;
};

/// The whole tree in parts: subtrees that are walked in parallel, and the nodes above them.
class Gathering {
  public:
    Gathering(const LooseTree& tree, const std::optional<Rule>& rule) : tree_(tree), rule_(rule) {
        cut();
        parts_.resize(top_.size());
        std::atomic<bool> tooDeep = false;
        parallelChunks(subtrees_.size(), 1, [&](size_t begin, size_t) {
            const TopNode& root = top_[subtrees_[begin]];
            Part& part = parts_[subtrees_[begin]];
            try {
                part.cost = Walk(tree_, rule_, part).walk(root.index, root.depth, part.root);
            } catch (const TooDeep&) {
                tooDeep = true;
            }
        });
        if (tooDeep) throw TooDeep();
        for (auto i = uint32_t(top_.size()); i-- > 0;)
            if (top_[i].children != 0) join(i);
    }

    double cost() const { return parts_[0].cost; }

    /// Joins the parts into one tree.
    Bvh gather() {
        places_.resize(top_.size());
        place(0);
        Buffer<Node> nodes(nodeCount_);
        Buffer<uint32_t> primitives(primitiveCount_);
        nodes[0] = placedRoot(0);
        nodes[1] = {};
        for (const auto& [children, at] : placedPairs_)
            for (uint32_t side = 0; side < 2; ++side) nodes[at + side] = placedRoot(children + side);
        parallelChunks(placedParts_.size(), 1, [&](size_t begin, size_t) {
            const Part& part = parts_[placedParts_[begin]];
            const auto& [firstNode, firstPrimitive] = places_[placedParts_[begin]];
            for (size_t i = 0; i < part.nodes.size(); ++i) {
                Node node = part.nodes[i];
                node.first += node.isLeaf() ? firstPrimitive : firstNode;
                nodes[firstNode + i] = node;
            }
            std::copy(part.primitives.begin(), part.primitives.end(), primitives.data() + firstPrimitive);
        });
        return {std::move(nodes).share(), std::move(primitives).share()};
    }

  private:
    static constexpr size_t kSubtrees = 256, kWorthCutting = 8192;

    /// A node at or above the cut. `children` is the index of its left child in `top_`; the right child is
    /// the next. 0 means no children: the node is the root of a subtree, or a leaf.
    struct TopNode {
        uint32_t index, depth;
        uint32_t children = 0;
    };

    /// Opens nodes level by level until there are enough subtrees for all threads.
    void cut() {
        top_.push_back({0, 0});
        const size_t wanted = tree_.nodes.size() >= kWorthCutting ? kSubtrees : 1;
        size_t next = 0;
        while (next < top_.size() && top_.size() - next < wanted && top_[next].depth < kMaxDepth) {
            const Node& node = tree_.nodes[top_[next].index];
            if (!node.isLeaf()) {
                top_[next].children = uint32_t(top_.size());
                const uint32_t depth = top_[next].depth + 1;
                top_.push_back({node.left(), depth});
                top_.push_back({node.right(), depth});
            }
            ++next;
        }
        for (uint32_t i = 0; i < top_.size(); ++i)
            if (top_[i].children == 0) subtrees_.push_back(i);
    }

    /// Computes the cost of a node above the cut. If the node becomes a leaf, makes a part of it.
    void join(uint32_t top) {
        Part& part = parts_[top];
        const Node& node = tree_.nodes[top_[top].index];
        const uint32_t children = top_[top].children;
        part.root = {node.bounds, 0, 0};
        if (!rule_) return;
        part.cost = rule_->costs.traversal * halfArea(node.bounds) + parts_[children].cost +
                    parts_[children + 1].cost;
        std::vector<uint32_t> primitives;
        if (!collect(top, primitives)) return;
        part.primitives = std::move(primitives);
        if (Walk(tree_, rule_, part).becomesLeaf(0, part.cost, part.root))
            top_[top].children = 0;
        else
            part.primitives = {};
    }

    /// Appends the primitives below a top node. Returns false if there are too many for a leaf.
    bool collect(uint32_t top, std::vector<uint32_t>& primitives) const {
        const uint32_t children = top_[top].children;
        if (children != 0) return collect(children, primitives) && collect(children + 1, primitives);
        const std::vector<uint32_t>& below = parts_[top].primitives;
        primitives.insert(primitives.end(), below.begin(), below.end());
        return primitives.size() / 4 <= rule_->maxLeafSize;
    }

    /// Assigns places in the whole tree to the subtree of a top node.
    void place(uint32_t top) {
        const uint32_t children = top_[top].children;
        if (children == 0) {
            const Part& part = parts_[top];
            places_[top] = {nodeCount_, primitiveCount_};
            nodeCount_ += uint32_t(part.nodes.size());
            primitiveCount_ += uint32_t(part.primitives.size());
            placedParts_.push_back(top);
            return;
        }
        parts_[top].root.first = nodeCount_;
        placedPairs_.push_back({children, nodeCount_});
        nodeCount_ += 2;
        place(children);
        place(children + 1);
    }

    /// Returns the root of a part, with indices into the whole tree.
    Node placedRoot(uint32_t top) const {
        Node node = parts_[top].root;
        if (top_[top].children == 0) node.first += node.isLeaf() ? places_[top].second : places_[top].first;
        return node;
    }

    const LooseTree& tree_;
    const std::optional<Rule>& rule_;
    std::vector<TopNode> top_;
    std::vector<uint32_t> subtrees_;
    std::vector<Part> parts_;                                 // one for each of top_
    std::vector<std::pair<uint32_t, uint32_t>> places_;       // of each part's nodes and primitives
    std::vector<std::pair<uint32_t, uint32_t>> placedPairs_;  // of top nodes, and their places
    std::vector<uint32_t> placedParts_;
    uint32_t nodeCount_ = 2, primitiveCount_ = 0;
};

/// Calls body(Gathering) for the tree. If the tree is too deep, balances it first.
template <class Body>
auto gatherWith(const LooseTree& tree, const std::optional<Rule>& rule, const Body& body) {
    try {
        return body(Gathering(tree, rule));
    } catch (const TooDeep&) {
        const std::vector<Node> nodes = limitDepth(tree.nodes);
        return body(Gathering({nodes, tree.primitives}, rule));
    }
}

Rule ruleFor(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize) {
    // Triangles are numbered without gaps, and each is in a leaf, so the highest number gives their count.
    const auto highest = std::max_element(tree.primitives.begin(), tree.primitives.end());
    return {costs, maxLeafSize, tree.primitives.size() > size_t(*highest) + 1};
}

}  // namespace

Bvh depthFirst(const LooseTree& tree) {
    return gatherWith(tree, std::nullopt, [](Gathering&& gathering) { return gathering.gather(); });
}

Bvh collapse(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize) {
    return gatherWith(tree, ruleFor(tree, costs, maxLeafSize),
                      [](Gathering&& gathering) { return gathering.gather(); });
}

double collapsedCost(const LooseTree& tree, const SahCosts& costs, uint32_t maxLeafSize) {
    const double rootArea = halfArea(tree.nodes[0].bounds);
    if (!(rootArea > 0)) return sahCost(collapse(tree, costs, maxLeafSize), costs);
    return gatherWith(tree, ruleFor(tree, costs, maxLeafSize),
                      [&](const Gathering& gathering) { return gathering.cost() / rootArea; });
}

}  // namespace bvhio
