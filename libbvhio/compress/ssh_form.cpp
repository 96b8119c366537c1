#include "compress/ssh_form.h"

#include <cmath>

#include "core/error.h"

namespace bvhio {
namespace {

float& plane(Aabb& box, uint32_t side) {
    return side < 3 ? box.min[int(side)] : box.max[int(side) - 3];
}
float plane(const Aabb& box, uint32_t side) {
    return side < 3 ? box.min[int(side)] : box.max[int(side) - 3];
}

/// Moves the side of `inherited` to where `box` has it that leaves the least area, the first of equals, and
/// returns it.
uint32_t carve(Aabb& inherited, const Aabb& box) {
    uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    Aabb result = inherited;
    for (const uint32_t side : {0u, 3u, 1u, 4u, 2u, 5u}) {
        Aabb carved = inherited;
        plane(carved, side) = plane(box, side);
        const double area = halfArea(carved);
        if (area < least) {
            least = area;
            best = side;
            result = carved;
        }
    }
    inherited = result;
    return best;
}

/// The axis along which two boxes' centers lie furthest apart.
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

/// The canonical tree with no leaf above the form's size: larger ones are halved, each half within the same
/// box. New pairs stand behind all others.
Bvh withSmallLeaves(const Bvh& bvh) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Node leaf = nodes[i];
        if (leaf.primitiveCount <= SshNode::kMaxLeafSize) continue;
        const auto pair = uint32_t(nodes.size());
        const uint32_t half = leaf.primitiveCount / 2;
        nodes.push_back({leaf.bounds, leaf.first, half});
        nodes.push_back({leaf.bounds, leaf.first + half, leaf.primitiveCount - half});
        nodes[i] = {leaf.bounds, pair, 0};
    }
    return {std::move(nodes), bvh.primitives};
}

}  // namespace

SshForm SshForm::encode(const Scene&, const Bvh& given, const EncodeOptions&) {
    if (given.primitives.size() > SshNode::kMaxReferences)
        throw Error(ErrorKind::unsupported, "the ssh form holds at most " +
                                                std::to_string(SshNode::kMaxReferences) +
                                                " references: use another --form");
    bool large = false;
    for (const Node& node : given.nodes) large |= node.primitiveCount > SshNode::kMaxLeafSize;
    const Bvh bvh = large ? withSmallLeaves(given) : given;

    Buffer<SshNode> nodes(bvh.nodes.size());
    nodes[1] = {};
    // The boxes that a pair's nodes inherit, and their place in the canonical tree: siblings may swap.
    Buffer<Aabb> inherited(bvh.nodes.size() / 2);
    Buffer<uint8_t> swapped(bvh.nodes.size() / 2);
    inherited[0] = bvh.nodes[0].bounds;
    swapped[0] = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (i == 1) continue;
        const Node& node = bvh.nodes[i ^ swapped[i / 2]];
        Aabb box = inherited[i / 2];
        const uint32_t side = carve(box, node.bounds);
        const float at = plane(node.bounds, side);
        if (node.isLeaf()) {
            nodes[i] = SshNode::leaf(at, side, node.first, node.primitiveCount);
            continue;
        }
        const Aabb &left = bvh.nodes[node.left()].bounds, &right = bvh.nodes[node.right()].bounds;
        const int split = separatingAxis(left, right);
        const size_t pair = node.left() / 2;
        inherited[pair] = box;
        swapped[pair] =
            double(left.min[split]) + left.max[split] > double(right.min[split]) + right.max[split];
        nodes[i] = SshNode::inner(at, side, uint32_t(split), node.left());
    }
    return {bvh.nodes[0].bounds, std::move(nodes).share(), bvh.primitives};
}

Bvh SshForm::decode() const {
    Buffer<Node> nodes(nodes_.size());
    nodes[1] = {};
    for (size_t i = 0; i < nodes_.size(); ++i) {
        if (i == 1) continue;
        const SshNode& node = nodes_[i];
        // An inner node leaves its box with its children, which lie behind it.
        Aabb box = i == 0 ? bounds_ : nodes[i].bounds;
        plane(box, node.side()) = node.plane;
        if (node.isLeaf()) {
            nodes[i] = {box, node.firstPrimitive(), node.primitiveCount()};
        } else {
            nodes[i] = {box, node.left(), 0};
            nodes[node.left()].bounds = nodes[node.left() + 1].bounds = box;
        }
    }
    return {std::move(nodes).share(), primitives_};
}

}  // namespace bvhio
