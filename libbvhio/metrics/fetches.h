// Reports the data that traversal fetches to listeners, in the order in which one thread fetches it.
//
// A fetch is a run of bytes in one of four arrays: the node records that the form's step reports; and, for
// each triangle of an entered leaf, its entry in the primitive array, its three indices and its three
// vertices, as BLB counts them (metrics/metrics.h). These are the scene's arrays. The copy of the triangles
// that timed runs use (trace/triangle_blocks.h) is not one of them.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "metrics/no_metrics.h"
#include "scene/scene.h"

namespace bvhio {

enum class FetchedArray : uint8_t { nodes, primitives, indices, vertices };
inline constexpr std::array<std::string_view, 4> kFetchedArrayNames{"nodes", "primitives", "indices",
                                                                    "vertices"};

/// The sizes of the arrays in bytes. Every fetch is inside its array.
using FetchedArraySizes = std::array<uint64_t, 4>;

class FetchListener {
  public:
    virtual ~FetchListener() = default;
    /// Starts the fetches of the ray that is traced index-th.
    virtual void rayBegins(size_t index) = 0;
    virtual void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) = 0;
};

/// The metrics policy that reports to listeners; almost free without any. Call `beginRay` before each ray.
class FetchMetrics : public NoMetrics {
  public:
    /// `primitives` is the form's primitive array.
    FetchMetrics(std::span<FetchListener* const> listeners, const Scene& scene,
                 std::span<const uint32_t> primitives)
        : listeners_(listeners), scene_(scene), primitives_(primitives) {}

    void beginRay(size_t index) {
        for (FetchListener* listener : listeners_) listener->rayBegins(index);
    }
    void recordFetched(size_t offset, size_t bytes) {
        for (FetchListener* listener : listeners_)
            listener->fetched(FetchedArray::nodes, offset, uint32_t(bytes));
    }
    void leafEntered(PrimitiveRange range) {
        if (!listeners_.empty()) reportTriangles(range);
    }

  private:
    void reportTriangles(PrimitiveRange range) const;

    std::span<FetchListener* const> listeners_;
    const Scene& scene_;
    std::span<const uint32_t> primitives_;
};

}  // namespace bvhio
