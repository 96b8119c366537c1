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

class Builder {
  public:
    Builder(const InsetFrame& frame, uint8_t* codes) : frame_(frame), codes_(codes) {}

    /// Puts the run's references, which the box holds, into the order of its leaves, and writes its codes.
    /// Large parts are built side by side.
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
        const auto buildLeft = [&] {
            build(run.left(), cutBox(frame_, box, codes[0]), references.first(half));
        };
        TaskGroup others;
        if (half >= kForkSize)
            others.run(buildLeft);
        else
            buildLeft();
        build(run.right(), cutBox(frame_, box, codes[1]), references.subspan(half));
        others.wait();
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
    static constexpr size_t kForkSize = 4096;

    enum class Key { center, low, high };
    static double valueOf(const Reference& reference, Key key, int axis) {
        const double low = reference.box.min[axis], high = reference.box.max[axis];
        return key == Key::center ? low + high : key == Key::low ? low : high;
    }

    const InsetFrame& frame_;
    uint8_t* codes_;
};

/// Decodes one tree after the other, its nodes below the root pair by pair.
class Decoder {
  public:
    Decoder(const RootPlaces& places, std::span<const uint8_t> codes, Buffer<Node>& nodes)
        : places_(places), codes_(codes), nodes_(nodes) {}

    Node root(size_t tree) {
        const PrimitiveRange run = places_.runs[tree];
        return node(tree, {run.first, run.count}, places_.insets[tree], places_.bounds[tree]);
    }

  private:
    Node node(size_t tree, MvhRun run, const InsetBox& box, const Aabb& bounds) {
        if (run.isLeaf()) return {bounds, run.first, run.count};
        const size_t pair = next_;
        next_ += 2;
        const uint32_t codes = codes_[run.codes()];
        const auto child = [&](uint32_t code, MvhRun childRun) {
            const InsetBox childBox = cutBox(places_.frame(tree), box, code);
            return node(tree, childRun, childBox, places_.floats(tree, childBox));
        };
        nodes_[pair] = child(codes & 15, run.left());
        nodes_[pair + 1] = child(codes >> 4, run.right());
        return {bounds, uint32_t(pair), 0};
    }

    const RootPlaces& places_;
    std::span<const uint8_t> codes_;
    Buffer<Node>& nodes_;
    size_t next_ = 0;
};

}  // namespace

MvhBlases MvhBlases::encode(const RootPlaces& places, std::span<uint32_t> primitives,
                            std::span<const Aabb> boxes, std::span<const uint32_t> ordered) {
    Buffer<uint8_t> codes(byteCount(primitives.size()));
    std::fill_n(codes.data(), codes.size(), uint8_t(0));
    const size_t grain = places.frames.size() == 1 ? 256 : 1;  // trees of meshes may be large
    parallelChunks(places.runs.size(), grain, [&](size_t begin, size_t end) {
        std::vector<Reference> references;
        for (size_t i = begin; i < end; ++i) {
            const MvhRun run{places.runs[i].first, places.runs[i].count};
            references.resize(run.count);
            for (uint32_t k = 0; k < run.count; ++k)
                references[k] = {boxes[run.first + k], primitives[run.first + k]};
            Builder builder(places.frame(i), codes.data());
            if (ordered[run.first] == run.count)
                builder.code(run, places.insets[i], references);
            else
                builder.build(run, places.insets[i], references);
            for (uint32_t k = 0; k < run.count; ++k) primitives[run.first + k] = references[k].primitive;
        }
    });
    return MvhBlases(std::move(codes).share());
}

Forest MvhBlases::decode(const RootPlaces& places) const {
    size_t slots = 0;
    for (const PrimitiveRange& run : places.runs) slots += MvhRun{run.first, run.count}.slotsBelow();
    Buffer<Node> roots(places.runs.size()), nodes(slots);
    Decoder decoder(places, codes_, nodes);
    for (size_t i = 0; i < roots.size(); ++i) roots[i] = decoder.root(i);
    return {std::move(roots).share(), std::move(nodes).share()};
}

}  // namespace bvhio
