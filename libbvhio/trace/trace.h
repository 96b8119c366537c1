// Traces batches of rays through an encoded BVH.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "compress/forms.h"
#include "trace/node_storage.h"
#include "trace/trace_form.h"
#include "trace/triangle_blocks.h"

namespace bvhio {

/// The source of a leaf's triangles. The hits are the same.
enum class TriangleSource {
    indexed,  // the scene, through its indices, without preparation: the fastest way to the first ray after
              // opening a file
    blocks,   // a copy made for tracing: about twice as fast, with 48 bytes for each triangle
};

/// Traces batches of rays, on all threads that the caller's ThreadLimit allows. Hits do not depend on the
/// number of threads, the processor, the form, the tree, or the source of triangles: they are those of brute
/// force over all triangles (see core/intersect.h for the proof). Refers to the scene and the BVH, which must
/// outlive the tracer.
class Tracer {
  public:
    Tracer(const Scene& scene, const EncodedBvh& bvh, TriangleSource source = TriangleSource::blocks);

    /// Stores the nodes of the aabb form in another way. They are traced in triangle blocks by code for the
    /// most basic processor, so times can be compared with each other, but not with those of other tracers.
    /// Throws Error{usage} for other forms, and Error{unsupported} if leaves are too large.
    Tracer(const Scene& scene, const EncodedBvh& bvh, const NodeStorage& storage);

    /// Finds the closest hit of each ray; among equal t, the lowest primitive index. Sizes must be equal.
    void closestHits(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// Writes for each ray 1 if it hits anything, and else 0. Sizes must be equal.
    void anyHits(std::span<const Ray> rays, std::span<uint8_t> occluded) const;

    /// Runs the queries again, more slowly, and counts their costs; times are measured without this. `perRay`
    /// is empty, or has an element for each ray. All fetches are reported to listeners, ray after ray, on one
    /// thread.
    TraceMeasurement measure(std::span<const Ray> rays, QueryKind query, std::span<RayCounts> perRay = {},
                             std::span<FetchListener* const> listeners = {}) const;

    /// Returns the sizes of the arrays whose fetches are reported to listeners.
    FetchedArraySizes arraySizes() const;

    /// Returns the bytes of the copy of the triangles; 0 if there is none.
    size_t preparedBytes() const { return blocks_ ? blocks_->bytes() : 0; }

  private:
    const Scene& scene_;
    const EncodedBvh& bvh_;
    std::optional<TriangleBlocks> blocks_;
    std::optional<StoredNodes> stored_;
};

/// Find the hits that every tree must find, by testing every triangle.
Hit bruteForceClosestHit(const Scene& scene, const Ray& ray);
bool bruteForceAnyHit(const Scene& scene, const Ray& ray);

}  // namespace bvhio
