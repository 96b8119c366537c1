// Ray files (.rays): "BVHRAYS1", uint64 count, then per ray eight float32: origin xyz, tMin, direction xyz,
// tMax; little-endian.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/ray.h"

namespace bvhio {

/// Returns the bytes of a ray file.
std::vector<std::byte> encodeRays(std::span<const Ray> rays);

/// Reads a whole ray file; `name` is for messages. Any float is allowed: invalid rays miss by definition (see
/// Ray). Throws Error{invalid} if it is not a header followed by exactly as many rays as the header says.
std::vector<Ray> decodeRays(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
