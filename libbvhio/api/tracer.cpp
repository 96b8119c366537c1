// Traces rays, for readers.
#include <array>
#include <cstddef>

#include "api/content.h"
#include "api/status.h"
#include "core/parallel.h"
#include "rays/hit_file.h"
#include "trace/trace.h"

static_assert(sizeof(BvhioRay) == sizeof(bvhio::Ray) &&
              offsetof(BvhioRay, origin) == offsetof(bvhio::Ray, origin) &&
              offsetof(BvhioRay, tMin) == offsetof(bvhio::Ray, tMin) &&
              offsetof(BvhioRay, direction) == offsetof(bvhio::Ray, direction) &&
              offsetof(BvhioRay, tMax) == offsetof(bvhio::Ray, tMax));
static_assert(sizeof(BvhioHit) == sizeof(bvhio::HitRecord) &&
              offsetof(BvhioHit, t) == offsetof(bvhio::HitRecord, t) &&
              offsetof(BvhioHit, u) == offsetof(bvhio::HitRecord, u) &&
              offsetof(BvhioHit, v) == offsetof(bvhio::HitRecord, v) &&
              offsetof(BvhioHit, primitive) == offsetof(bvhio::HitRecord, primitive) &&
              offsetof(BvhioHit, geometry) == offsetof(bvhio::HitRecord, geometry) &&
              offsetof(BvhioHit, instance) == offsetof(bvhio::HitRecord, instance));

struct BvhioTracer {
    std::shared_ptr<const bvhio::Content> content;  // the tracer uses its arrays
    bvhio::Tracer tracer;
};

namespace bvhio {
namespace {

// The number of rays per task of the library's tracer, so that it traces a batch on the calling thread.
constexpr size_t kBatch = 1024;

std::span<const Ray> raysIn(const BvhioRay* rays, size_t count) {
    return {reinterpret_cast<const Ray*>(rays), count};
}

BvhioHit hitIn(const Scene& scene, const Hit& hit) {
    const HitRecord record = hitRecord(scene, hit);
    return {record.t, record.u, record.v, record.primitive, record.geometry, record.instance};
}

/// Traces at most kBatch rays.
void traceBatch(const BvhioTracer& from, std::span<const Ray> rays, BvhioHit* hits, uint32_t* primitives) {
    std::array<Hit, kBatch> found;
    from.tracer.closestHits(rays, std::span(found).first(rays.size()));
    for (size_t i = 0; i < rays.size(); ++i) {
        hits[i] = hitIn(from.content->file.scene, found[i]);
        if (primitives != nullptr) primitives[i] = found[i].primitive;
    }
}

/// Calls batch(begin, end) over all rays, on at most `threads` threads.
template <class Batch>
void forBatches(size_t count, uint32_t threads, const Batch& batch) {
    if (count <= kBatch || threads == 1) {
        for (size_t begin = 0; begin < count; begin += kBatch) batch(begin, std::min(count, begin + kBatch));
    } else {
        const ThreadLimit limit(threads);
        parallelChunks(count, kBatch, batch);
    }
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

BvhioStatus bvhioCreateTracer(const BvhioContainer* container, uint32_t flags, const BvhioContext* context,
                              BvhioTracer** tracer) {
    return guarded([&] {
        requirePointer(tracer, "tracer");
        *tracer = nullptr;
        requirePointer(container, "container");
        if ((flags & ~BVHIO_NO_COPY) != 0)
            throw Error(ErrorKind::usage,
                        "unknown flags " + std::to_string(flags) + ": use 0 or BVHIO_NO_COPY");
        const auto source = (flags & BVHIO_NO_COPY) != 0 ? TriangleSource::indexed : TriangleSource::blocks;
        const std::shared_ptr<const Content>& content = container->content;
        const ThreadLimit limit(context == nullptr ? 0 : context->threads);
        *tracer = new BvhioTracer{content, Tracer(content->file.scene, content->file.bvh, source)};
    });
}

void bvhioDestroyTracer(BvhioTracer* tracer) {
    delete tracer;
}

BvhioStatus bvhioTraceClosest(const BvhioTracer* tracer, const BvhioRay* rays, size_t count, BvhioHit* hits,
                              uint32_t* primitives, uint32_t threads) {
    return guarded([&] {
        requirePointer(tracer, "tracer");
        if (count == 0) return;
        requirePointer(rays, "rays");
        requirePointer(hits, "hits");
        forBatches(count, threads, [&](size_t begin, size_t end) {
            traceBatch(*tracer, raysIn(rays + begin, end - begin), hits + begin,
                       primitives == nullptr ? nullptr : primitives + begin);
        });
    });
}

BvhioStatus bvhioTraceAny(const BvhioTracer* tracer, const BvhioRay* rays, size_t count, uint8_t* occluded,
                          uint32_t threads) {
    return guarded([&] {
        requirePointer(tracer, "tracer");
        if (count == 0) return;
        requirePointer(rays, "rays");
        requirePointer(occluded, "occluded");
        forBatches(count, threads, [&](size_t begin, size_t end) {
            tracer->tracer.anyHits(raysIn(rays + begin, end - begin), {occluded + begin, end - begin});
        });
    });
}

int bvhioTraceRay(const BvhioTracer* tracer, const BvhioRay* ray, BvhioHit* hit, uint32_t* primitive) {
    Hit found;
    tracer->tracer.closestHits(raysIn(ray, 1), {&found, 1});
    if (hit != nullptr) *hit = hitIn(tracer->content->file.scene, found);
    if (primitive != nullptr) *primitive = found.primitive;
    return found.isMiss() ? 0 : 1;
}

int bvhioIsOccluded(const BvhioTracer* tracer, const BvhioRay* ray) {
    uint8_t occluded = 0;
    tracer->tracer.anyHits(raysIn(ray, 1), {&occluded, 1});
    return occluded;
}
}
