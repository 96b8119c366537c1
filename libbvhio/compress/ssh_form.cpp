#include "compress/ssh_form.h"

#include <cmath>

#include "compress/divide_leaves.h"
#include "compress/reference_limit.h"

namespace bvhio {
namespace {

float& plane(Aabb& box, uint32_t side) {
    return side < 3 ? box.min[int(side)] : box.max[int(side) - 3];
}
float plane(const Aabb& box, uint32_t side) {
    return side < 3 ? box.min[int(side)] : box.max[int(side) - 3];
}

/// How far the sides of an inner box lie inside those of an outer one, by axis.
struct Inset {
    double low[3], high[3];

    Inset(const Aabb& outer, const Aabb& inner) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = double(component(inner.min, axis)) - component(outer.min, axis);
            high[axis] = double(component(outer.max, axis)) - component(inner.max, axis);
        }
    }
    double larger(int axis) const { return std::max(low[axis], high[axis]); }
};

/// Moves one side of `inherited` to the same side of `node`'s box, and returns the side. For a leaf it is the
/// side that leaves the least area. For an inner node it is the side after which the best planes of both
/// children leave the least area, since children need not save again what the node's plane has saved. Of
/// equal sides it is the first, and never one that does not move if another does. So a decoded tree is
/// encoded to the same nodes again.
uint32_t carve(Aabb& inherited, const Node& node, std::span<const Node> nodes) {
    constexpr double kOwnWeight =
        0.4;  // the weight of the node's area against its children's; found by trial
    const bool isInner = !node.isLeaf();
    const Inset own(inherited, node.bounds);
    const Inset children[2] = {Inset(inherited, isInner ? nodes[node.left()].bounds : node.bounds),
                               Inset(inherited, isInner ? nodes[node.right()].bounds : node.bounds)};
    const double extent[3] = {double(inherited.max.x) - inherited.min.x,
                              double(inherited.max.y) - inherited.min.y,
                              double(inherited.max.z) - inherited.min.z};
    uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const bool atLow : {true, false}) {
            const double moved = atLow ? own.low[axis] : own.high[axis];
            if (moved == 0) continue;
            const double left = extent[axis] - moved;
            const double area = extent[u] * extent[v] + left * (extent[u] + extent[v]);
            double cost = area;
            if (isInner) {
                cost *= kOwnWeight;
                for (const Inset& child : children) {
                    // The area that the child's best plane saves, on whichever axis it is.
                    const double same = std::max(child.low[axis] - (atLow ? moved : 0),
                                                 child.high[axis] - (atLow ? 0 : moved));
                    const double saved = std::max(
                        same * (extent[u] + extent[v]),
                        std::max(child.larger(u) * (left + extent[v]), child.larger(v) * (left + extent[u])));
                    cost += area - saved;
                }
            }
            if (cost < least) {
                least = cost;
                best = uint32_t(atLow ? axis : axis + 3);
            }
        }
    }
    plane(inherited, best) = plane(node.bounds, best);
    return best;
}

/// Returns the axis along which two boxes' centers lie furthest apart.
int separatingAxis(const Aabb& a, const Aabb& b) {
    int best = 0;
    double widest = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const double distance =
            std::abs((double(a.min[axis]) + a.max[axis]) - (double(b.min[axis]) + b.max[axis]));
        if (distance > widest) {
            widest = distance;
            best = axis;
        }
    }
    return best;
}

/// Encodes nodes, parents first. Each node records the box that its children inherit, and their order.
class PairEncoder {
  public:
    explicit PairEncoder(const SharedArray<Node>& nodes)
        : nodes_(nodes), inherited_(nodes.size() / 2), swapped_(nodes.size() / 2) {}

    /// Encodes the node for index i, whose parent was encoded before. It is the given node or its sibling.
    SshNode at(size_t i) { return code(nodes_[i ^ swapped_[i / 2]], inherited_[i / 2]); }

    SshNode code(const Node& node, Aabb box) {
        const uint32_t side = carve(box, node, nodes_);
        const float plane = bvhio::plane(node.bounds, side);
        if (node.isLeaf()) return SshNode::leaf(plane, side, node.first, node.primitiveCount);
        const Aabb &left = nodes_[node.left()].bounds, &right = nodes_[node.right()].bounds;
        const int split = separatingAxis(left, right);
        const size_t pair = node.left() / 2;
        inherited_[pair] = box;
        swapped_[pair] =
            double(left.min[split]) + left.max[split] > double(right.min[split]) + right.max[split];
        return SshNode::inner(plane, side, uint32_t(split), node.left());
    }

  private:
    const SharedArray<Node>& nodes_;
    Buffer<Aabb> inherited_;
    Buffer<uint8_t> swapped_;
};

/// Returns the decoded node with its box. An inner node's children in `nodes` inherit the box.
Node decoded(uint32_t word, const Aabb& box, Buffer<Node>& nodes) {
    const SshNode node{0, word};
    if (node.isLeaf()) return {box, node.firstPrimitive(), node.primitiveCount()};
    nodes[node.left()].bounds = nodes[node.left() + 1].bounds = box;
    return {box, node.left(), 0};
}

Node decoded(const SshNode& node, Aabb box, Buffer<Node>& nodes) {
    plane(box, node.side()) = node.plane;
    return decoded(node.word, box, nodes);
}

}  // namespace

SshForm SshForm::encode(const Scene&, const Bvh& bvh, const Options&) {
    refuseMoreThan(SshNode::kMaxReferences, bvh.primitives.size(), kName);
    const SharedArray<Node> given = divideLeaves(bvh, SshNode::kMaxLeafSize).nodes;
    PairEncoder encoder(given);
    Buffer<SshNode> nodes(given.size());
    nodes[0] = encoder.code(given[0], given[0].bounds);
    nodes[1] = {};
    for (size_t i = 2; i < nodes.size(); ++i) nodes[i] = encoder.at(i);
    return {given[0].bounds, std::move(nodes).share(), bvh.primitives};
}

SshForm::Trees SshForm::encodeTrees(const Forest& forest, std::span<const Aabb> boxes, size_t references) {
    refuseMoreThan(SshNode::kMaxReferences, references, kName);
    const Forest given = divideLeaves(forest, SshNode::kMaxLeafSize);
    PairEncoder encoder(given.nodes);
    Buffer<uint32_t> roots(given.roots.size());
    Buffer<SshNode> nodes(given.nodes.size());
    for (size_t i = 0; i < roots.size(); ++i) {
        const Node& root = given.roots[i];
        roots[i] = encoder.code({boxes[i], root.first, root.primitiveCount}, boxes[i]).word;
    }
    for (size_t i = 0; i < nodes.size(); ++i) nodes[i] = encoder.at(i);
    return {std::move(roots).share(), std::move(nodes).share()};
}

Bvh SshForm::decode() const {
    Buffer<Node> nodes(nodes_.size());
    nodes[0] = decoded(nodes_[0], bounds_, nodes);
    nodes[1] = {};
    for (size_t i = 2; i < nodes_.size(); ++i) nodes[i] = decoded(nodes_[i], nodes[i].bounds, nodes);
    return {std::move(nodes).share(), primitives_};
}

Forest SshForm::decodeTrees(const Trees& trees, std::span<const Aabb> boxes) {
    Buffer<Node> roots(trees.roots.size()), nodes(trees.nodes.size());
    for (size_t i = 0; i < roots.size(); ++i) roots[i] = decoded(trees.roots[i], boxes[i], nodes);
    for (size_t i = 0; i < nodes.size(); ++i) nodes[i] = decoded(trees.nodes[i], nodes[i].bounds, nodes);
    return {std::move(roots).share(), std::move(nodes).share()};
}

}  // namespace bvhio
