#include "compress/quantized_form.h"

#include <algorithm>

#include "compress/divide_leaves.h"
#include "compress/inset_box.h"
#include "core/buffer.h"
#include "core/error.h"

namespace bvhio {
namespace {

/// A box whose sides may be moved inwards by steps, up to 2^bits - 1 of them. Coordinates of sides 3 to 5 are
/// negated here: for all sides larger ones are further inside.
class Grid {
  public:
    Grid(const InsetFrame& frame, const InsetBox& box, uint32_t bits) : box_(box), most_((1u << bits) - 1) {
        for (int axis = 0; axis < 3; ++axis) {
            step_[axis] = frame.size(box, axis) / double(1u << bits);
            root_[axis] = frame.bounds().min[axis];
            root_[axis + 3] = -frame.bounds().max[axis];
        }
    }

    /// The box of a child.
    InsetBox child(const QuantizedRecord& record, uint32_t child) const {
        InsetBox result = box_;
        for (uint32_t side = 0; side < 6; ++side)
            if (uint32_t(record.isRights(side)) == child)
                (side < 3 ? result.min : result.max)[side % 3] = inset(side, record.inset(side));
        return result;
    }

    /// Sets the planes of a record for two boxes: each as far inwards as the box allows that lies further
    /// inside.
    void setPlanes(QuantizedRecord& record, const Aabb& left, const Aabb& right) const {
        double stepsOfUnit[3];
        for (int axis = 0; axis < 3; ++axis) stepsOfUnit[axis] = 1 / step_[axis];
        for (uint32_t side = 0; side < 6; ++side) {
            const double start = plane(side, 0);
            const double outermost = InsetFrame::upwards(start);
            const double toLeft = coordinate(left, side), toRight = coordinate(right, side);
            const bool isRights = toRight > toLeft;
            const double target = isRights ? toRight : toLeft;
            if (target <= outermost) continue;
            const double estimate = (target - start) * stepsOfUnit[side % 3];
            uint32_t steps = estimate < most_ ? uint32_t(estimate) : most_;
            while (steps > 0 && plane(side, steps) > target) --steps;
            while (steps < most_ && plane(side, steps + 1) <= target) ++steps;
            // Where that takes no float off the box the plane stays: so what a decoded tree has is encoded to
            // itself.
            if (plane(side, steps) > outermost) record.setPlane(side, steps, isRights);
        }
    }

  private:
    double inset(uint32_t side, uint32_t steps) const {
        return (side < 3 ? box_.min : box_.max)[side % 3] + steps * step_[side % 3];
    }
    double plane(uint32_t side, uint32_t steps) const { return root_[side] + inset(side, steps); }
    static double coordinate(const Aabb& box, uint32_t side) {
        return side < 3 ? box.min[int(side)] : -box.max[int(side) - 3];
    }

    const InsetBox& box_;
    double step_[3], root_[6];
    uint32_t most_;
};

}  // namespace

QuantizedForm QuantizedForm::encode(const Scene&, const Bvh& given, const EncodeOptions& options) {
    if (given.primitives.size() > QuantizedRecord::kMaxReferences)
        throw Error(ErrorKind::unsupported, "the quantized form holds at most " +
                                                std::to_string(QuantizedRecord::kMaxReferences) +
                                                " references: use another --form");
    const Bvh bvh = divideLeaves(given, QuantizedRecord::kMaxLeafSize);
    const Aabb& bounds = bvh.nodes[0].bounds;
    const InsetFrame frame(bounds);

    // Record r is of nodes 2 r + 2 and 2 r + 3; boxes[r] is their parent's. Parents come first.
    Buffer<QuantizedRecord> records(bvh.nodes.size() / 2 - 1);
    std::vector<InsetBox> boxes(records.size());
    for (size_t r = 0; r < records.size(); ++r) {
        const Node* pair = &bvh.nodes[2 * r + 2];
        const Grid grid(frame, boxes[r], options.bits);
        QuantizedRecord record{};
        grid.setPlanes(record, pair[0].bounds, pair[1].bounds);
        for (uint32_t child = 0; child < 2; ++child) {
            const Node& node = pair[child];
            if (node.isLeaf()) {
                record.setLeaf(child, node.first, node.primitiveCount);
            } else {
                record.setInner(child, node.left() / 2 - 1);
                boxes[node.left() / 2 - 1] = grid.child(record, child);
            }
        }
        records[r] = record;
    }
    return {bounds, options.bits, std::move(records).share(), bvh.primitives};
}

Bvh QuantizedForm::decode(InsetBox* insets) const {
    const InsetFrame frame(bounds_);
    Buffer<Node> nodes(2 * records_.size() + 2);
    nodes[0] = {bounds_, 2, 0};
    if (records_.empty()) nodes[0] = {bounds_, 0, uint32_t(primitives_.size())};
    nodes[1] = {};
    std::vector<InsetBox> boxes(records_.size());
    for (size_t r = 0; r < records_.size(); ++r) {
        const QuantizedRecord& record = records_[r];
        const Grid grid(frame, boxes[r], bits_);
        for (uint32_t child = 0; child < 2; ++child) {
            const InsetBox box = grid.child(record, child);
            const uint32_t word = record.children[child];
            if (insets != nullptr) insets[2 * r + 2 + child] = box;
            Node& node = nodes[2 * r + 2 + child];
            node.bounds = frame.floats(box);
            if (QuantizedRecord::isLeaf(word)) {
                node.first = QuantizedRecord::firstPrimitive(word);
                node.primitiveCount = QuantizedRecord::primitiveCount(word, record.more(child));
            } else {
                node.first = 2 * QuantizedRecord::record(word) + 2;
                node.primitiveCount = 0;
                boxes[QuantizedRecord::record(word)] = box;
            }
        }
    }
    return {std::move(nodes).share(), primitives_};
}

}  // namespace bvhio
