// What a form must offer: how nodes are stored, and how a ray steps through them as stored.
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

#include "core/bvh.h"

namespace bvhio {

/// A run of entries in the form's primitive array.
struct PrimitiveRange {
    uint32_t first, count;
};

/// A form stores a BVH and knows how to decode it. What tracing asks of a form, its Cursor and steps, is added to this concept
/// beside the loop that uses them.
template <class F>
concept Form = requires(const F form) {
    { F::kName } -> std::convertible_to<std::string_view>;
    { F::kSummary } -> std::convertible_to<std::string_view>;
    { form.decode() } -> std::same_as<Bvh>;                                     // boxes as reconstructed
    { form.primitives() } -> std::convertible_to<std::span<const uint32_t>>;    // leaf order -> triangle
    { form.nodeBytes() } -> std::same_as<size_t>;                               // in memory, nodes only
};

}  // namespace bvhio
