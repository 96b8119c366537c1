// Hit files (.hits): "BVHHITS1", uint64 count, then per ray float32 t, u, v, uint32 primitive, geometry,
// instance; little-endian. And the hash of hits, which tells in a word whether two runs agree.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/ray.h"
#include "scene/scene.h"

namespace bvhio {

/// A hit in a scene's own ids, which no builder, form or layout changes: 24 bytes, stored as is. `primitive`
/// is the triangle within its `geometry`, both in source order; `instance` counts those of an instanced
/// scene, and is 0 in a plain one. A miss has all three ids 0xFFFFFFFF, t infinite and u = v = 0.
struct HitRecord {
    float t = std::numeric_limits<float>::infinity();
    float u = 0, v = 0;
    uint32_t primitive = kNoPrimitive, geometry = kNoPrimitive, instance = kNoPrimitive;

    bool isMiss() const { return primitive == kNoPrimitive; }
};
static_assert(sizeof(HitRecord) == 24);

/// The records of hits in `scene`, in order.
std::vector<HitRecord> hitRecords(const Scene& scene, std::span<const Hit> hits);

/// The bytes of a hit file.
std::vector<std::byte> encodeHits(std::span<const HitRecord> records);

/// Reads a whole hit file; `name` is for messages. Throws Error{invalid} for anything but a header and
/// exactly as many hits as it says.
std::vector<HitRecord> decodeHits(std::span<const std::byte> bytes, const std::string& name);

/// XXH3-64 of the records as a hit file stores them, without its header.
uint64_t hitHash(std::span<const HitRecord> records);

}  // namespace bvhio
