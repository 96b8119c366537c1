#include "metrics/fetches.h"

namespace bvhio {

void FetchMetrics::reportTriangles(PrimitiveRange range) const {
    const auto report = [&](FetchedArray array, size_t element, size_t bytes) {
        for (FetchListener* listener : listeners_) listener->fetched(array, element * bytes, uint32_t(bytes));
    };
    for (uint32_t i = range.first; i < range.first + range.count; ++i) {
        report(FetchedArray::primitives, i, sizeof(uint32_t));
        const uint32_t triangle = primitives_[i];
        report(FetchedArray::indices, triangle, sizeof(TriangleIndices));
        const TriangleIndices& indices = scene_.triangles[triangle];
        for (const uint32_t vertex : {indices.v0, indices.v1, indices.v2})
            report(FetchedArray::vertices, vertex, sizeof(Vec3));
    }
}

}  // namespace bvhio
