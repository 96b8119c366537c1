#include "compress/mvh_blases.h"

#include <algorithm>

#include "core/buffer.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/sah_cost.h"

namespace bvhio {

InsetBox cutBox(const InsetFrame& frame, const InsetBox& box, uint32_t code) {
    const MvhCut cut = mvhCut(code);
    InsetBox result = box;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = frame.size(box, axis);
        result.min[axis] += cut.min[axis] * size;
        result.max[axis] += cut.max[axis] * size;
    }
    return result;
}

namespace {

struct Reference {
    Aabb box;
    uint32_t primitive;
};

double areaOf(const InsetFrame& frame, const InsetBox& box) {
    const double x = frame.size(box, 0), y = frame.size(box, 1), z = frame.size(box, 2);
    return x * y + y * z + z * x;
}

bool holds(const InsetFrame& frame, const InsetBox& box, const Aabb& inner) {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
        holds &= frame.minPlane(box.min[axis], axis) <= inner.min[axis] &&
                 frame.maxPlane(box.max[axis], axis) >= inner.max[axis];
    return holds;
}

/// The code that leaves the least area of a box that still holds `inner`, which the box does.
uint32_t bestCode(const InsetFrame& frame, const InsetBox& box, const Aabb& inner) {
    uint32_t best = 0;
    double least = areaOf(frame, box);
    for (uint32_t code = 1; code < kMvhCodes; ++code) {
        const InsetBox child = cutBox(frame, box, code);
        const double area = areaOf(frame, child);
        if (area < least && holds(frame, child, inner)) {
            least = area;
            best = code;
        }
    }
    return best;
}

Aabb boundsOf(std::span<const Reference> references) {
    Aabb box = Aabb::empty();
    for (const Reference& reference : references) box.extend(reference.box);
    return box;
}

/// Builds one tree after the other; keeps its memory.
class Builder {
  public:
    Builder(const InsetFrame& frame, uint8_t* codes) : frame_(frame), codes_(codes) {}

    /// Puts the run's references, which the box holds, into the order of its leaves, and writes its codes.
    void build(MvhRun run, const InsetBox& box, std::span<Reference> references) {
        const auto byPrimitive = [](const Reference& a, const Reference& b) {
            return a.primitive < b.primitive;
        };
        if (run.isLeaf()) return std::sort(references.begin(), references.end(), byPrimitive);
        // Each axis by centers, low and high sides. Of the split that serves best the order is kept: the one
        // of least count * (area as coded + twice the area as it should be).
        const size_t half = run.leftCount();
        double least = std::numeric_limits<double>::infinity();
        uint32_t codes[2] = {};
        std::vector<Reference> best(references.size());
        for (int axis = 0; axis < 3; ++axis)
            for (const Key key : {Key::center, Key::low, Key::high}) {
                const auto below = [&](const Reference& a, const Reference& b) {
                    const double x = valueOf(a, key, axis), y = valueOf(b, key, axis);
                    return x < y || (x == y && a.primitive < b.primitive);
                };
                std::nth_element(references.begin(), references.begin() + std::ptrdiff_t(half),
                                 references.end(), below);
                const std::span<Reference> parts[2] = {references.first(half), references.subspan(half)};
                double cost = 0;
                uint32_t found[2];
                for (int part = 0; part < 2; ++part) {
                    const Aabb bounds = boundsOf(parts[part]);
                    found[part] = bestCode(frame_, box, bounds);
                    cost += double(parts[part].size()) *
                            (areaOf(frame_, cutBox(frame_, box, found[part])) + 2 * halfArea(bounds));
                }
                if (cost < least) {
                    least = cost;
                    std::copy(found, found + 2, codes);
                    std::copy(references.begin(), references.end(), best.begin());
                }
            }
        std::copy(best.begin(), best.end(), references.begin());
        codes_[run.codes()] = uint8_t(codes[0] | codes[1] << 4);
        build(run.left(), cutBox(frame_, box, codes[0]), references.first(half));
        build(run.right(), cutBox(frame_, box, codes[1]), references.subspan(half));
    }

    /// Only writes the codes: the references are in order.
    void code(MvhRun run, const InsetBox& box, std::span<const Reference> references) {
        if (run.isLeaf()) return;
        const std::span<const Reference> left = references.first(run.leftCount()),
                                         right = references.subspan(run.leftCount());
        const uint32_t ofLeft = bestCode(frame_, box, boundsOf(left)),
                       ofRight = bestCode(frame_, box, boundsOf(right));
        codes_[run.codes()] = uint8_t(ofLeft | ofRight << 4);
        code(run.left(), cutBox(frame_, box, ofLeft), left);
        code(run.right(), cutBox(frame_, box, ofRight), right);
    }

  private:
    enum class Key { center, low, high };
    static double valueOf(const Reference& reference, Key key, int axis) {
        const double low = reference.box.min[axis], high = reference.box.max[axis];
        return key == Key::center ? low + high : key == Key::low ? low : high;
    }

    const InsetFrame& frame_;
    uint8_t* codes_;
};

std::vector<size_t> leavesOf(const Bvh& top) {
    std::vector<size_t> leaves;
    for (size_t i = 0; i < top.nodes.size(); ++i)
        if (top.nodes[i].isLeaf()) leaves.push_back(i);
    return leaves;
}

/// What of a box lies in its parent's: insets of a box with full-precision planes may be a little too small.
Aabb within(const Aabb& parent, Aabb box) {
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::max(box.min[axis], parent.min[axis]);
        box.max[axis] = std::min(box.max[axis], parent.max[axis]);
    }
    return box;
}

/// Writes the nodes below one that is placed in `nodes` already, pair by pair from `next` on.
void decodeBelow(MvhRun run, const InsetBox& box, size_t node, const InsetFrame& frame,
                 std::span<const uint8_t> codes, Buffer<Node>& nodes, size_t& next) {
    if (run.isLeaf()) {
        nodes[node].first = run.first;
        nodes[node].primitiveCount = run.count;
        return;
    }
    const size_t pair = next;
    next += 2;
    nodes[node].first = uint32_t(pair);
    nodes[node].primitiveCount = 0;
    const uint32_t both = codes[run.codes()];
    const InsetBox left = cutBox(frame, box, both & 15), right = cutBox(frame, box, both >> 4);
    nodes[pair].bounds = within(nodes[node].bounds, frame.floats(left));
    nodes[pair + 1].bounds = within(nodes[node].bounds, frame.floats(right));
    decodeBelow(run.left(), left, pair, frame, codes, nodes, next);
    decodeBelow(run.right(), right, pair + 1, frame, codes, nodes, next);
}

}  // namespace

MvhBlases MvhBlases::encode(const DecodedTlas& top, std::span<uint32_t> primitives,
                            std::span<const Aabb> boxes, std::span<const uint32_t> ordered) {
    const InsetFrame frame(top.bvh.nodes[0].bounds);
    const std::vector<size_t> leaves = leavesOf(top.bvh);
    Buffer<uint8_t> codes(byteCount(primitives.size()));
    std::fill_n(codes.data(), codes.size(), uint8_t(0));
    parallelChunks(leaves.size(), 256, [&](size_t begin, size_t end) {
        Builder builder(frame, codes.data());
        std::vector<Reference> references;
        for (size_t i = begin; i < end; ++i) {
            const Node& leaf = top.bvh.nodes[leaves[i]];
            references.resize(leaf.primitiveCount);
            for (uint32_t k = 0; k < leaf.primitiveCount; ++k)
                references[k] = {boxes[leaf.first + k], primitives[leaf.first + k]};
            const MvhRun run{leaf.first, leaf.primitiveCount};
            if (ordered[run.first] == run.count)
                builder.code(run, top.insets[leaves[i]], references);
            else
                builder.build(run, top.insets[leaves[i]], references);
            for (uint32_t k = 0; k < leaf.primitiveCount; ++k)
                primitives[leaf.first + k] = references[k].primitive;
        }
    });
    return MvhBlases(std::move(codes).share());
}

Bvh MvhBlases::decode(const DecodedTlas& top, SharedArray<uint32_t> primitives) const {
    const InsetFrame frame(top.bvh.nodes[0].bounds);
    const std::vector<size_t> leaves = leavesOf(top.bvh);
    size_t slots = top.bvh.nodes.size();
    for (const size_t leaf : leaves)
        slots += 2 * (MvhRun{0, top.bvh.nodes[leaf].primitiveCount}.leafCount() - 1);
    Buffer<Node> nodes(slots);
    std::copy(top.bvh.nodes.begin(), top.bvh.nodes.end(), nodes.data());
    size_t next = top.bvh.nodes.size();
    for (const size_t i : leaves) {
        const Node& leaf = top.bvh.nodes[i];
        decodeBelow({leaf.first, leaf.primitiveCount}, top.insets[i], i, frame, codes_, nodes, next);
    }
    return {std::move(nodes).share(), std::move(primitives)};
}

}  // namespace bvhio
