// The interface of a form, which stores a tree. trace/step_FORM.h steps rays through the stored tree.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>

#include "compress/form_option.h"
#include "compress/form_traits.h"
#include "core/intersect.h"
#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

/// A run of entries in the form's primitive array.
struct PrimitiveRange {
    uint32_t first, count;
};

/// A form stores a BVH and decodes it.
///
/// - Options: how to encode. `optionTable` describes them.
/// - kTraits: what the form does to a tree.
/// - kCandidates: the options that a search for the best form tries, as bvh-compress takes them ("--leaf-size
///   8"); an empty text for the defaults.
/// - encode: encodes a valid tree over the scene. Boxes may grow. Leaves keep their triangles or are divided.
template <class F>
concept Form = requires(const F form, const Scene scene, const Bvh bvh, const typename F::Options options) {
    { F::kName } -> std::convertible_to<std::string_view>;
    { F::kSummary } -> std::convertible_to<std::string_view>;
    { F::kTraits } -> std::convertible_to<FormTraits>;
    { F::kCandidates } -> std::convertible_to<std::span<const std::string_view>>;
    { F::optionTable() } -> std::same_as<std::span<const FormOption<typename F::Options>>>;
    { F::encode(scene, bvh, options) } -> std::same_as<F>;
    { form.options() } -> std::same_as<typename F::Options>;  // to encode another tree in the same way
    { form.decode() } -> std::same_as<Bvh>;                   // with boxes as reconstructed
    { form.primitives() } -> std::convertible_to<std::span<const uint32_t>>;  // leaf order -> triangle
    { form.nodeBytes() } -> std::same_as<size_t>;                             // in memory, nodes only
};

}  // namespace bvhio
