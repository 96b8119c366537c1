#include "rays/hit_file.h"

#include "core/hash.h"
#include "core/parallel.h"
#include "rays/record_file.h"

namespace bvhio {

namespace {
constexpr char kHitSignature[9] = "BVHHITS1";
}

HitRecord hitRecord(const Scene& scene, const Hit& hit) {
    if (hit.isMiss()) return {};
    const Scene::PrimitiveId id = scene.primitiveId(hit.primitive);
    return {hit.t, hit.u, hit.v, id.primitive, id.geometry, id.instance};
}

std::vector<HitRecord> hitRecords(const Scene& scene, std::span<const Hit> hits) {
    std::vector<HitRecord> records(hits.size());
    parallelChunks(hits.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) records[i] = hitRecord(scene, hits[i]);
    });
    return records;
}

std::vector<std::byte> encodeHits(std::span<const HitRecord> records) {
    return encodeRecords(kHitSignature, records);
}

std::vector<HitRecord> decodeHits(std::span<const std::byte> bytes, const std::string& name) {
    return decodeRecords<HitRecord>(kHitSignature, bytes, "hits", name);
}

uint64_t hitHash(std::span<const HitRecord> records) {
    return hash64(std::as_bytes(records));
}

}  // namespace bvhio
