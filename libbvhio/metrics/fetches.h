// What traversal reads, told to listeners in the order in which one thread reads it.
//
// A fetch is a run of bytes in one of four arrays: node records, as the form's step tells them; and of each
// triangle of a leaf that is entered, as BLB counts them (metrics/metrics.h): its entry in the primitive
// array, its three indices, its three vertices. These are the scene's arrays: the copy of the triangles that
// timed runs use (trace/triangle_blocks.h) is none of them.
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

/// The sizes of the arrays in bytes: every fetch lies within.
using FetchedArraySizes = std::array<uint64_t, 4>;

class FetchListener {
  public:
    virtual ~FetchListener() = default;
    /// What follows is of the ray traced index-th.
    virtual void rayBegins(size_t index) = 0;
    virtual void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) = 0;
};

/// The metrics policy that tells listeners; nearly free when there are none. Call `beginRay` before each ray.
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
        if (!listeners_.empty()) tellTriangles(range);
    }

  private:
    void tellTriangles(PrimitiveRange range) const;

    std::span<FetchListener* const> listeners_;
    const Scene& scene_;
    std::span<const uint32_t> primitives_;
};

}  // namespace bvhio
