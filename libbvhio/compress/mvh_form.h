// The mvh form: a Minimal BVH over the whole scene, two bits a node. compress/mvh_tree.h has the tree itself,
// the paper it is from and the departures.
#pragma once

#include "compress/mvh_step.h"

namespace bvhio {

class MvhForm {
  public:
    static constexpr std::string_view kName = "mvh";
    static constexpr std::string_view kSummary = "2 bits a node, a complete tree of its own (Minimal BVH)";
    static constexpr int kMaxChildren = 4;
    /// Per box, as the planes of both children are made together: half of 3 sizes, 2 products and 4 planes;
    /// 2 differences and 2 products. Half of 2 comparisons for the axis; 2 for the interval, 2 to compare.
    static constexpr BoxTestCost kBoxTestCost{9, 5};

    class Cursor {
      public:
        Cursor() = default;
        BVHIO_INLINE Cursor(const MvhPart& whole, uint32_t number, uint32_t turn)
            : part(whole), node_(uint64_t(turn) << 32 | number) {}
        // As they were written: what was just written in other pieces can't be read for a while.
        BVHIO_INLINE Cursor(const Cursor& other) : part(other.part), node_(other.node_) {}
        BVHIO_INLINE Cursor& operator=(const Cursor& other) {
            part = other.part;
            node_ = other.node_;
            return *this;
        }

        BVHIO_INLINE uint32_t node() const { return uint32_t(node_); }
        BVHIO_INLINE uint32_t turn() const { return uint32_t(node_ >> 32); }
        MvhPart part;

      private:
        uint64_t node_;  // the upper half is whose turn it is
    };

    /// `words` as in format-spec/mvh.md.
    MvhForm(const Aabb& bounds, const MvhParameters& parameters, SharedArray<uint32_t> words,
            SharedArray<uint32_t> primitives)
        : bounds_(bounds),
          parameters_(parameters),
          tables_(parameters.rule),
          shape_(uint32_t(primitives.size()), parameters.leafSize),
          words_(std::move(words)),
          primitives_(std::move(primitives)) {}

    /// Builds its own tree over the scene's triangles, unless options ask for the given one.
    static MvhForm encode(const Scene& scene, const Bvh& bvh, const EncodeOptions& options);

    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    const MvhParameters& parameters() const { return parameters_; }
    const MvhShape& shape() const { return shape_; }
    /// How many words the nibbles of a tree of this shape take: two bits a node, the root's unused.
    static size_t wordCount(const MvhShape& shape) { return (size_t(shape.leafCount()) + 7) / 8; }
    const SharedArray<uint32_t>& words() const { return words_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    EncodeOptions options() const {
        return {.leafSize = parameters_.leafSize,
                .zeta = parameters_.rule.zeta,
                .zetaOfBoth = parameters_.rule.zetaOfBoth,
                .cutAxes = parameters_.rule.axes,
                .mvhBuild = MvhBuild::given};
    }
    size_t nodeBytes() const { return words_.size() * sizeof(uint32_t); }

    using Ray = MvhRay;
    MvhRay prepare(const PreparedRay& ray) const { return MvhRay(ray); }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const MvhRay& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        metrics.boxesTested(1, BoxTestCost{12, 12});
        const RayInterval interval = clipToBox(ray.ray, bounds_, tLimit);
        root = {{MvhPart(ray, bounds_, interval), 0, 0}, interval.enter};
        return !interval.isEmpty();
    }

    /// A record is the word that has a node's nibble; those of siblings count as one.
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const MvhRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        const uint32_t node = from.cursor.node(), left = 2 * node + 1;
        const bool twoLevels = left + 1 < shape_.innerCount();
        const uint32_t* const words = words_.data();
        MvhStep step;
        stepMvh(tables_, ray, mvhNibble(words, node), twoLevels ? mvhNibble(words, left) : 0,
                twoLevels ? mvhNibble(words, left + 1) : 0, twoLevels, from.cursor.part, from.cursor.turn(),
                tLimit, step);
        const auto enter = [&](uint32_t i) {
            const uint32_t lane = step.lane(i);
            const uint32_t child = twoLevels ? 2 * left + 1 + lane : left + lane / 2;
            children[i].cursor = {step.parts[lane], child, uint32_t(step.turns[lane])};
            children[i].enter = step.parts[lane].enter();
        };
        for (uint32_t i = 1; i < step.count; ++i) enter(i);
        enter(0);  // the last, as the traversal goes on there; means nothing where none is entered
        metrics.boxesTested(twoLevels ? 6 : 2, kBoxTestCost);
        metrics.recordFetched(size_t(node) / 8 * sizeof(uint32_t), sizeof(uint32_t));
        if (twoLevels) metrics.recordFetched(size_t(left) / 8 * sizeof(uint32_t), sizeof(uint32_t));
        return int(step.count);
    }

    bool isLeaf(const Cursor& cursor) const { return shape_.isLeaf(cursor.node()); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return shape_.primitiveRange(cursor.node()); }

  private:
    Aabb bounds_;
    MvhParameters parameters_;
    MvhTables tables_;
    MvhShape shape_;
    SharedArray<uint32_t> words_;
    SharedArray<uint32_t> primitives_;
};
static_assert(Form<MvhForm>);

}  // namespace bvhio
