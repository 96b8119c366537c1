// The two-level form: the top of the tree (TLAS) is in one form, and below each of its leaves a small tree
// (BLAS) is in another. All BLASes share one array. After the two-level MVH of P. Bauszat, M. Eisemann and M.
// Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010, whose top has full nodes and whose bottom has
// their minimal ones: the few nodes that every ray visits may be large, and the many that few rays visit are
// small.
//
// The same form holds instances (after S. G. Rubin and T. Whitted, "A 3-Dimensional Representation for Fast
// Rendering of Complex Scenes", SIGGRAPH 1980). Then BLASes are trees over the scene's meshes, each in the
// mesh's own space, and a leaf of the top level is an instance that refers to one of them.
//
// Departures: each level may be in one of several forms, the root of a BLAS has the box of the leaf above it,
// and the tree is cut into subtrees of at most a given number of primitives.
#pragma once

#include <array>
#include <type_traits>
#include <variant>

#include "compress/blases.h"
#include "compress/placed_blases.h"
#include "compress/tlas.h"
#include "compress/two_levels.h"
#include "scene/instanced_bvh.h"

namespace bvhio {

/// Forms of the levels, the default first.
enum class TlasForm : uint8_t { quantized, aabb };
enum class BlasForm : uint8_t { mvh, ssh, quantized, aabb };

class TwoLevelForm {
  public:
    static constexpr std::string_view kName = "two-level";
    static constexpr std::string_view kSummary =
        "a top level over many small trees, each in a form of its own";
    /// The levels may be in any of their forms, so a trait is set if one of these forms has it.
    static constexpr FormTraits kTraits{.dividesLeaves = true, .mergesLeaves = true, .holdsInstances = true};
    static constexpr std::array<std::string_view, 7> kCandidates{
        "--tlas-form quantized --blas-form mvh --blas-size 16",
        "--tlas-form quantized --blas-form mvh --blas-size 80",
        "--tlas-form quantized --blas-form mvh --blas-size 128",
        "--tlas-form aabb --blas-form mvh --blas-size 16",
        "--tlas-form aabb --blas-form ssh --blas-size 16",
        "--tlas-form aabb --blas-form ssh --blas-size 32",
        "--tlas-form aabb --blas-form ssh --blas-size 64"};

    struct Options {
        TlasForm tlasForm{};
        BlasForm blasForm{};
        uint32_t blasSize = 80;      // primitives per BLAS at most, unless a single leaf has more
        uint32_t bits = 8;           // per plane of quantized levels, 5 to 8
        uint32_t blasLeafSize = 16;  // triangles per leaf of mvh BLASes, 1 to 16
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable();
    /// Returns options for both levels in the aabb form, in which instances are built. It keeps all boxes.
    static Options exactLevels() { return {.tlasForm = TlasForm::aabb, .blasForm = BlasForm::aabb}; }

    /// In the order of TlasForm and BlasForm.
    using Tlas = std::variant<QuantizedTlas, AabbTlas>;
    using Blases = std::variant<NibbleBlases, SshBlases, QuantizedBlases, AabbBlases>;

    /// Each leaf of `tlas` has one entry: the index of an entry of `placed`, or without `placed`, of a BLAS.
    /// If BLASes are runs, and without `placed`, a leaf owns the run of primitives of its BLAS instead. If
    /// both levels are quantized, their planes have the same number of bits. As in format-spec/two-level.md.
    TwoLevelForm(Tlas tlas, Blases blases, SharedArray<uint32_t> primitives, uint32_t blasSize,
                 PlacedBlases placed = {})
        : tlas_(std::move(tlas)),
          blases_(std::move(blases)),
          primitives_(std::move(primitives)),
          blasSize_(blasSize),
          placed_(std::move(placed)) {}

    /// Encodes a valid tree. O(n). Throws Error{unsupported} if a form of a level does.
    static TwoLevelForm encode(const Scene& scene, const Bvh& bvh, const Options& options);

    /// Encodes valid trees over an instanced scene. Throws Error{unsupported} if a form of a level does.
    static TwoLevelForm encodeInstances(const Scene& scene, const InstancedBvh& bvh, const Options& options);

    /// Decodes to one tree: the nodes of the top level, followed by those of the bottom level. Throws
    /// Error{usage} if the form holds instances, whose trees do not form one tree.
    Bvh decode() const;
    bool isInstanced() const { return !placed_.empty(); }
    /// Decodes to the trees of an instanced scene.
    InstancedBvh decodeInstances(const Scene& scene) const;
    /// Decodes both levels, as stored. Leaves of the top refer to BLASes, or to entries of `placed`.
    TwoLevels decodeLevels() const;
    const PlacedBlases& placed() const { return placed_; }
    const Tlas& tlas() const { return tlas_; }
    const Blases& blases() const { return blases_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    Options options() const;
    size_t tlasBytes() const;
    size_t nodeBytes() const;

  private:
    Tlas tlas_;
    Blases blases_;
    SharedArray<uint32_t> primitives_;
    uint32_t blasSize_;
    PlacedBlases placed_;
};
static_assert(Form<TwoLevelForm>);

namespace detail {
template <class... Levels>
constexpr std::array<std::string_view, sizeof...(Levels)> formNames(const std::variant<Levels...>*) {
    return {Levels::kName...};
}
}  // namespace detail

/// Returns the names of the forms of a level, by TlasForm or BlasForm.
template <class LevelForm>
std::span<const std::string_view> levelForms() {
    using Level =
        std::conditional_t<std::is_same_v<LevelForm, TlasForm>, TwoLevelForm::Tlas, TwoLevelForm::Blases>;
    static constexpr auto kNames = detail::formNames(static_cast<const Level*>(nullptr));
    return kNames;
}

}  // namespace bvhio
