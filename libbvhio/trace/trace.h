// Rays through an encoded BVH, in batches.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "compress/forms.h"
#include "trace/node_storage.h"
#include "trace/trace_form.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

/// Where leaves find their triangles. The hits are the same.
enum class TriangleSource {
    indexed,  // in the scene, through its indices: nothing to prepare, the way to the first ray after opening
              // a file
    blocks,   // in a copy made for tracing: about twice as fast, at 48 bytes for each triangle
};

/// Traces batches of rays, on all threads that the caller's ThreadLimit leaves. Hits do not depend on the
/// number of threads, the processor, the form, the tree, or the source of triangles: they are those of brute
/// force over all triangles (core/intersect.h has the proof). Refers to the scene and the BVH, which must
/// outlive it.
class Tracer {
  public:
    Tracer(const Scene& scene, const EncodedBvh& bvh, TriangleSource source = TriangleSource::blocks);

    /// Nodes of the aabb form stored in another way, and traced in triangle blocks by code for the most basic
    /// processor: times compare with each other, not with those of other tracers. Throws Error{usage} for
    /// other forms, Error{unsupported} where leaves are too large.
    Tracer(const Scene& scene, const EncodedBvh& bvh, const NodeStorage& storage);

    /// The closest hit of each ray; among equal t the lowest primitive index. Sizes must be equal.
    void closestHits(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// For each ray 1 when it hits anything, else 0. Sizes must be equal.
    void anyHits(std::span<const Ray> rays, std::span<uint8_t> occluded) const;

    /// Runs the queries once more, slower, and counts what they cost; times are measured without this.
    /// `perRay`, when not empty, has one element for each ray. Listeners hear of all fetches, ray after ray,
    /// on one thread.
    TraceMeasurement measure(std::span<const Ray> rays, Query query, std::span<RayCounts> perRay = {},
                             std::span<FetchListener* const> listeners = {}) const;

    /// Of the arrays whose fetches listeners hear of.
    FetchedArraySizes arraySizes() const;

    /// Bytes of the copy of the triangles; 0 without one.
    size_t preparedBytes() const { return blocks_ ? blocks_->bytes() : 0; }

  private:
    const Scene& scene_;
    const EncodedBvh& bvh_;
    std::optional<TriangleBlocks> blocks_;
    std::optional<StoredNodes> stored_;
};

/// What every tree must give, found by testing every triangle.
Hit bruteForceClosestHit(const Scene& scene, const Ray& ray);
bool bruteForceAnyHit(const Scene& scene, const Ray& ray);

}  // namespace bvhio
