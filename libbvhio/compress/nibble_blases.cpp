#include "compress/nibble_blases.h"

#include <algorithm>

#include "core/buffer.h"
#include "core/error.h"
#include "core/parallel.h"
#include "tree/sah_cost.h"

namespace bvhio {

InsetBox cutBox(const InsetFrame& frame, const InsetBox& box, uint32_t code) {
    const NibbleCut cut = nibbleCut(code);
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

/// Returns the code that shrinks `box` to the least area that still holds `inner`. The box holds it uncut.
uint32_t bestCode(const InsetFrame& frame, const InsetBox& box, const Aabb& inner) {
    uint32_t best = 0;
    double least = areaOf(frame, box);
    for (uint32_t code = 1; code < kNibbleCodes; ++code) {
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
    Builder(const NibbleRuns& shape, const InsetFrame& frame, uint8_t* codes)
        : shape_(shape), frame_(frame), codes_(codes) {}

    /// Puts the run's references into the order of its leaves, and writes the codes. The box must hold the
    /// references. Large parts are built in parallel.
    void build(const NibbleRun& run, const InsetBox& box, std::span<Reference> references) {
        const auto byPrimitive = [](const Reference& a, const Reference& b) {
            return a.primitive < b.primitive;
        };
        if (run.isLeaf()) return std::sort(references.begin(), references.end(), byPrimitive);
        // Sort along each axis by the centers, the low and the high sides of boxes. Keep the order of the
        // best split: the one with the least sum of count * (area as coded + 2 * exact area) over the two
        // parts.
        const size_t half = shape_.left(run).count;
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
        // Write the codes, and build both parts.
        std::copy(best.begin(), best.end(), references.begin());
        codes_[run.codes()] = uint8_t(codes[0] | codes[1] << 4);
        const auto buildLeft = [&] {
            build(shape_.left(run), cutBox(frame_, box, codes[0]), references.first(half));
        };
        TaskGroup others;
        if (half >= kForkSize)
            others.run(buildLeft);
        else
            buildLeft();
        build(shape_.right(run), cutBox(frame_, box, codes[1]), references.subspan(half));
        others.wait();
    }

    /// Writes the codes of references that already are in order.
    void code(const NibbleRun& run, const InsetBox& box, std::span<const Reference> references) {
        if (run.isLeaf()) return;
        const std::span<const Reference> left = references.first(shape_.left(run).count),
                                         right = references.subspan(shape_.left(run).count);
        const uint32_t ofLeft = bestCode(frame_, box, boundsOf(left)),
                       ofRight = bestCode(frame_, box, boundsOf(right));
        codes_[run.codes()] = uint8_t(ofLeft | ofRight << 4);
        code(shape_.left(run), cutBox(frame_, box, ofLeft), left);
        code(shape_.right(run), cutBox(frame_, box, ofRight), right);
    }

  private:
    static constexpr size_t kForkSize = 4096;

    enum class Key { center, low, high };
    static double valueOf(const Reference& reference, Key key, int axis) {
        const double low = reference.box.min[axis], high = reference.box.max[axis];
        return key == Key::center ? low + high : key == Key::low ? low : high;
    }

    const NibbleRuns& shape_;
    const InsetFrame& frame_;
    uint8_t* codes_;
};

/// Decodes the trees one after another. The nodes below each root are appended in pairs.
class Decoder {
  public:
    Decoder(const NibbleRuns& shape, const RootPlaces& places, std::span<const uint8_t> codes,
            Buffer<Node>& nodes)
        : shape_(shape), places_(places), codes_(codes), nodes_(nodes) {}

    Node root(size_t tree) {
        return node(tree, shape_.root(places_.runs[tree]), places_.insets[tree], places_.bounds[tree]);
    }

  private:
    Node node(size_t tree, const NibbleRun& run, const InsetBox& box, const Aabb& bounds) {
        if (run.isLeaf()) return {bounds, run.first, run.count};
        const size_t pair = next_;
        next_ += 2;
        const uint32_t codes = codes_[run.codes()];
        const auto child = [&](uint32_t code, const NibbleRun& childRun) {
            const InsetBox childBox = cutBox(places_.frame(tree), box, code);
            return node(tree, childRun, childBox, places_.floats(tree, childBox));
        };
        nodes_[pair] = child(codes & 15, shape_.left(run));
        nodes_[pair + 1] = child(codes >> 4, shape_.right(run));
        return {bounds, uint32_t(pair), 0};
    }

    const NibbleRuns& shape_;
    const RootPlaces& places_;
    std::span<const uint8_t> codes_;
    Buffer<Node>& nodes_;
    size_t next_ = 0;
};

}  // namespace

NibbleBlases NibbleBlases::encode(uint32_t leafSize, const RootPlaces& places, std::span<uint32_t> primitives,
                                  std::span<const Aabb> boxes, std::span<const uint32_t> ordered) {
    if (primitives.size() > NibbleRuns::kMaxReferences)
        throw Error(ErrorKind::unsupported, "BLASes in the mvh form hold at most " +
                                                std::to_string(NibbleRuns::kMaxReferences) +
                                                " references: use another --blas-form");
    const NibbleRuns shape(leafSize);
    Buffer<uint8_t> codes(shape.byteCount(primitives.size()));
    std::fill_n(codes.data(), codes.size(), uint8_t(0));
    // Trees of meshes may be large, so each of them is a task.
    const size_t grain = places.frames.size() == 1 ? 256 : 1;
    parallelChunks(places.runs.size(), grain, [&](size_t begin, size_t end) {
        std::vector<Reference> references;
        for (size_t i = begin; i < end; ++i) {
            const NibbleRun run = shape.root(places.runs[i]);
            references.resize(run.count);
            for (uint32_t k = 0; k < run.count; ++k)
                references[k] = {boxes[run.first + k], primitives[run.first + k]};
            Builder builder(shape, places.frame(i), codes.data());
            if (ordered[run.first] == run.count)
                builder.code(run, places.insets[i], references);
            else
                builder.build(run, places.insets[i], references);
            for (uint32_t k = 0; k < run.count; ++k) primitives[run.first + k] = references[k].primitive;
        }
    });
    return {leafSize, std::move(codes).share()};
}

Forest NibbleBlases::decode(const RootPlaces& places) const {
    size_t slots = 0;
    for (const PrimitiveRange& run : places.runs) slots += shape_.root(run).slotsBelow();
    Buffer<Node> roots(places.runs.size()), nodes(slots);
    Decoder decoder(shape_, places, codes_, nodes);
    for (size_t i = 0; i < roots.size(); ++i) roots[i] = decoder.root(i);
    return {std::move(roots).share(), std::move(nodes).share()};
}

}  // namespace bvhio
