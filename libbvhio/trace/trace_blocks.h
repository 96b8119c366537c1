// Tracing against triangle blocks, with the code for the processor at hand.
#pragma once

#include "compress/forms.h"
#include "core/ray.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

void closestHitsInBlocks(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays,
                         std::span<Hit> hits);
void anyHitsInBlocks(const EncodedBvh& bvh, const TriangleBlocks& blocks, std::span<const Ray> rays,
                     std::span<uint8_t> occluded);

}  // namespace bvhio
