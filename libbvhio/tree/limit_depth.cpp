#include "tree/limit_depth.h"

#include <algorithm>
#include <bit>

namespace bvhio {
namespace {

class DepthLimiter {
  public:
    explicit DepthLimiter(std::span<const Node> nodes)
        : nodes_(nodes.begin(), nodes.end()), leaves_(nodes.size()), heights_(nodes.size()) {}

    std::vector<Node> run() && {
        measure();
        std::vector<std::pair<uint32_t, uint32_t>> open{{0, 0}};  // nodes that stay, and their depths
        while (!open.empty()) {
            const auto [index, depth] = open.back();
            open.pop_back();
            if (depth + heights_[index] <= kMaxDepth) continue;
            const Node& node = nodes_[index];
            if (fits(node.left(), depth + 1) && fits(node.right(), depth + 1)) {
                open.push_back({node.left(), depth + 1});
                open.push_back({node.right(), depth + 1});
            } else {
                balance(index);
            }
        }
        return std::move(nodes_);
    }

  private:
    /// Returns whether a subtree at this depth would keep to the limit if it were balanced.
    bool fits(uint32_t index, uint32_t depth) const {
        return depth + uint32_t(std::bit_width(leaves_[index] - 1)) <= kMaxDepth;
    }

    /// Returns the nodes of a subtree, each before its children, left before right.
    std::vector<uint32_t> preorder(uint32_t root) const {
        std::vector<uint32_t> order, stack{root};
        while (!stack.empty()) {
            const uint32_t index = stack.back();
            stack.pop_back();
            order.push_back(index);
            if (nodes_[index].isLeaf()) continue;
            stack.push_back(nodes_[index].right());
            stack.push_back(nodes_[index].left());
        }
        return order;
    }

    /// Counts the leaves and finds the height of each subtree.
    void measure() {
        const std::vector<uint32_t> order = preorder(0);
        for (size_t i = order.size(); i-- > 0;) {
            const Node& node = nodes_[order[i]];
            const bool leaf = node.isLeaf();
            leaves_[order[i]] = leaf ? 1 : leaves_[node.left()] + leaves_[node.right()];
            heights_[order[i]] = leaf ? 0 : 1 + std::max(heights_[node.left()], heights_[node.right()]);
        }
    }

    /// Rebuilds a subtree as a balanced one over the same leaves.
    void balance(uint32_t root) {
        std::vector<Node> leaves;
        std::vector<uint32_t> pairs;
        for (const uint32_t index : preorder(root)) {
            if (nodes_[index].isLeaf())
                leaves.push_back(nodes_[index]);
            else
                pairs.push_back(nodes_[index].left());
        }
        nodes_[root] = halve(leaves, pairs);
    }

    /// Builds a balanced tree over leaves, in pairs that it takes from the end of `pairs`.
    Node halve(std::span<const Node> leaves, std::vector<uint32_t>& pairs) {
        if (leaves.size() == 1) return leaves[0];
        const uint32_t pair = pairs.back();
        pairs.pop_back();
        const Node left = halve(leaves.first(leaves.size() / 2), pairs);
        const Node right = halve(leaves.subspan(leaves.size() / 2), pairs);
        nodes_[pair] = left;
        nodes_[pair + 1] = right;
        return {unite(left.bounds, right.bounds), pair, 0};
    }

    std::vector<Node> nodes_;
    std::vector<uint32_t> leaves_, heights_;  // of each node's subtree
};

}  // namespace

std::vector<Node> limitDepth(std::span<const Node> nodes) {
    return DepthLimiter(nodes).run();
}

}  // namespace bvhio
