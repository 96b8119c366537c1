// The mvh form: a Minimal BVH over the whole scene, with two bits per node. compress/mvh_tree.h has the tree
// itself, its paper and the departures.
#pragma once

#include <array>

#include "compress/form_concept.h"
#include "compress/mvh_tables.h"

namespace bvhio {

class MvhForm {
  public:
    static constexpr std::string_view kName = "mvh";
    static constexpr std::string_view kSummary = "2 bits a node, a complete tree of its own (Minimal BVH)";
    static constexpr FormTraits kTraits{.mergesLeaves = true, .buildsOwnTree = true};
    static constexpr std::array<std::string_view, 3> kCandidates{"", "--leaf-size 8", "--leaf-size 16"};

    struct Options {
        uint32_t leafSize = 4;           // triangles per leaf, 1 to 16
        float zeta = 0, zetaOfBoth = 0;  // 0: as suits the tree
        uint32_t cutAxes = 0;            // 0: as suits the tree
        MvhBuild build = MvhBuild::best;
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable();

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
    static MvhForm encode(const Scene& scene, const Bvh& bvh, const Options& options);

    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    const MvhParameters& parameters() const { return parameters_; }
    const MvhTables& tables() const { return tables_; }
    const MvhShape& shape() const { return shape_; }
    /// Returns the words that hold a tree's nibbles: two bits per node; the root's are unused.
    static size_t wordCount(const MvhShape& shape) { return (size_t(shape.leafCount()) + 7) / 8; }
    const SharedArray<uint32_t>& words() const { return words_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    Options options() const {
        return {.leafSize = parameters_.leafSize,
                .zeta = parameters_.rule.zeta,
                .zetaOfBoth = parameters_.rule.zetaOfBoth,
                .cutAxes = parameters_.rule.axes,
                .build = MvhBuild::given};
    }
    size_t nodeBytes() const { return words_.size() * sizeof(uint32_t); }

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
