// What a form must offer to store a tree. How rays step through it as stored is in trace/step_FORM.h.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/intersect.h"
#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// A run of entries in the form's primitive array.
struct PrimitiveRange {
    uint32_t first, count;
};

/// How the mvh form divides triangles: with much choice, as its paper does (compress/mvh_build.h), or as the
/// given tree does, if that has the form's shape; others count as best.
enum class MvhBuild { best, paper, given };

/// Forms of the two-level form's levels, the default first.
enum class TlasForm : uint8_t { quantized, aabb };
enum class BlasForm : uint8_t { mvh, ssh, quantized, aabb };

/// What forms can be told; each takes what concerns it.
struct EncodeOptions {
    uint32_t bits = 8;  // quantized, a level of two in that form, too: of a plane, 5 to 8

    // quantized-short, for trees that are not in clusters
    uint32_t pointerBits = 8;  // 2 to 10
    uint32_t lineSize = 64;    // bytes: a power of two, 8 to 512

    // mvh
    uint32_t leafSize = 4;           // triangles in a leaf, 1 to 16
    float zeta = 0, zetaOfBoth = 0;  // 0, and below: as suits the tree
    uint32_t cutAxes = 0;
    MvhBuild mvhBuild = MvhBuild::best;

    // two-level
    TlasForm tlasForm{};
    BlasForm blasForm{};
    uint32_t blasSize = 80;      // primitives that a BLAS has at most, unless a single leaf has more
    uint32_t blasLeafSize = 16;  // of BLASes in the mvh form: triangles in a leaf, 1 to 16

    bool operator==(const EncodeOptions&) const = default;
};

/// A form stores a BVH and decodes it.
///
/// - encode: of a valid tree over the scene. Boxes may grow; leaves keep their triangles, but may be divided.
template <class F>
concept Form = requires(const F form, const Scene scene, const Bvh bvh, const EncodeOptions options) {
    { F::encode(scene, bvh, options) } -> std::same_as<F>;
    { form.options() } -> std::same_as<EncodeOptions>;  // that encode another tree alike
    { F::kName } -> std::convertible_to<std::string_view>;
    { F::kSummary } -> std::convertible_to<std::string_view>;
    { form.decode() } -> std::same_as<Bvh>;                                   // boxes as reconstructed
    { form.primitives() } -> std::convertible_to<std::span<const uint32_t>>;  // leaf order -> triangle
    { form.nodeBytes() } -> std::same_as<size_t>;                             // in memory, nodes only
};

}  // namespace bvhio
