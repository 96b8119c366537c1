// Hit files (.hits): "BVHHITS1", uint64 count, then per ray float32 t, u, v, uint32 primitive, geometry,
// instance; little-endian. And the hash of hits, one number by which runs can be compared.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/ray.h"
#include "scene/scene.h"

namespace bvhio {

/// A hit with ids of the source scene, which no builder, form or layout changes; 24 bytes, stored as is.
/// `primitive` is the number of the triangle within its `geometry`, both in source order. `instance` is the
/// number of the instance in an instanced scene, and 0 in a plain one. In a miss all three ids are
/// 0xFFFFFFFF, t is infinite and u = v = 0.
struct HitRecord {
    float t = std::numeric_limits<float>::infinity();
    float u = 0, v = 0;
    uint32_t primitive = kNoPrimitive, geometry = kNoPrimitive, instance = kNoPrimitive;

    bool isMiss() const { return primitive == kNoPrimitive; }
};
static_assert(sizeof(HitRecord) == 24);

/// Returns the record of a hit in `scene`.
HitRecord hitRecord(const Scene& scene, const Hit& hit);
/// Returns the records of hits in `scene`, in order.
std::vector<HitRecord> hitRecords(const Scene& scene, std::span<const Hit> hits);

/// Returns the bytes of a hit file.
std::vector<std::byte> encodeHits(std::span<const HitRecord> records);

/// Reads a whole hit file; `name` is for messages. Throws Error{invalid} if it is not a header followed by
/// exactly as many hits as the header says.
std::vector<HitRecord> decodeHits(std::span<const std::byte> bytes, const std::string& name);

/// Returns XXH3-64 of the records as in a hit file, without the header.
uint64_t hitHash(std::span<const HitRecord> records);

}  // namespace bvhio
