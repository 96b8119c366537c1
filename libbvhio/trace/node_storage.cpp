#include "trace/node_storage.h"

#include <algorithm>
#include <bit>

#include "core/error.h"

namespace bvhio {
namespace {

void setPlanes(float* planes, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) {
        planes[axis] = box.min[axis];
        planes[axis + 3] = box.max[axis];
    }
}

/// Returns the number of floats of an array of 16-byte elements.
size_t floatsOf16(size_t count) {
    if (count > size_t(1) << 28)
        throw Error(ErrorKind::unsupported, "arrays of 16 bytes hold at most 2^28 records, not " +
                                                std::to_string(count) + ": use another --node-storage");
    return behindArray(0, count * 16) / sizeof(float);
}

constexpr NodeStorage kNodeStorages[] = {
    {"pairs", "32-byte nodes, siblings side by side",
     [](const AabbForm& form) { return StoredNodes(NodesInPairs(form.bvh())); }},
    {"record", "64 bytes with both children's boxes and references",
     [](const AabbForm& form) { return StoredNodes(NodesIn<RecordArray>(form)); }},
    {"soa16-8", "these fields in three arrays of 16 bytes and one of 8",
     [](const AabbForm& form) { return StoredNodes(NodesIn<ArraysOf16And8>(form)); }},
    {"soa32-24", "these fields in an array of 32 bytes and one of 24",
     [](const AabbForm& form) { return StoredNodes(NodesIn<ArraysOf32And24>(form)); }},
};

}  // namespace

ChildReferences::ChildReferences(const Bvh& bvh) {
    uint32_t largest = 1;
    for (const Node& node : bvh.nodes) largest = std::max(largest, node.primitiveCount);
    firstBits_ = uint32_t(std::bit_width(bvh.primitives.size() - 1));
    if (firstBits_ + uint32_t(std::bit_width(largest - 1)) > 31)
        throw Error(ErrorKind::unsupported, "leaves of " + std::to_string(largest) + " triangles among " +
                                                std::to_string(bvh.primitives.size()) +
                                                " do not fit references of 31 bits: build with a smaller "
                                                "--max-leaf-size");
}

void RecordArray::set(size_t i, const Node& left, const Node& right, const ChildReferences& references) {
    Record& record = records_[i];
    setPlanes(record.boxes[0], left.bounds);
    setPlanes(record.boxes[1], right.bounds);
    record.children[0] = references.of(left);
    record.children[1] = references.of(right);
    record.unused[0] = record.unused[1] = 0;
}

void ArraysOf32And24::set(size_t i, const Node& left, const Node& right, const ChildReferences& references) {
    setPlanes(left_[i].planes, left.bounds);
    setPlanes(right_[i].planes, right.bounds);
    left_[i].children[0] = references.of(left);
    left_[i].children[1] = references.of(right);
}

ArraysOf16And8::ArraysOf16And8(size_t count)
    : arrayFloats_(floatsOf16(count)), planes_(3 * arrayFloats_), children_(count) {}

void ArraysOf16And8::set(size_t i, const Node& left, const Node& right, const ChildReferences& references) {
    float* const ofLeft = planes_.data() + 4 * i;
    float* const ofRight = ofLeft + arrayFloats_;
    float* const z = ofRight + arrayFloats_;
    const Aabb boxes[] = {left.bounds, right.bounds};
    for (const int side : {0, 1}) {
        const Aabb& box = boxes[side];
        float* const xy = side == 0 ? ofLeft : ofRight;
        xy[0] = box.min.x, xy[1] = box.max.x, xy[2] = box.min.y, xy[3] = box.max.y;
        z[2 * side] = box.min.z, z[2 * side + 1] = box.max.z;
    }
    children_[i] = {{references.of(left), references.of(right)}};
}

template <class Arrays>
NodesIn<Arrays>::NodesIn(const AabbForm& form)
    : bounds_(form.bvh().nodes[0].bounds),
      references_(form.bvh()),
      root_(references_.of(form.bvh().nodes[0])),
      arrays_(form.bvh().nodes.size() / 2 - 1),
      primitives_(form.bvh().primitives) {
    const auto& nodes = form.bvh().nodes;
    for (size_t pair = 2; pair < nodes.size(); pair += 2)
        arrays_.set(pair / 2 - 1, nodes[pair], nodes[pair + 1], references_);
}

template class NodesIn<RecordArray>;
template class NodesIn<ArraysOf16And8>;
template class NodesIn<ArraysOf32And24>;

std::span<const NodeStorage> nodeStorages() {
    return kNodeStorages;
}

}  // namespace bvhio
