// Tracing against triangle blocks, with the code for the processor at hand.
#pragma once

#include "compress/forms.h"
#include "core/ray.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

/// Specialised for each form, in a file of its own (trace/blocks_aabb.cpp and so on): the loop is compiled
/// for several processors, and forms that share nothing need not be compiled again together.
template <class F>
void closestHitsInBlocks(const F& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits);
template <class F>
void anyHitsInBlocks(const F& form, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded);

}  // namespace bvhio
