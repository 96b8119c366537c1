#include "trace/triangle_blocks.h"

#include <algorithm>

#include "core/parallel.h"

namespace bvhio {

TriangleBlocks::TriangleBlocks(const Scene& scene, std::span<const uint32_t> primitives,
                               std::span<const PrimitiveRange> leaves)
    : data_(kRowCount * primitives.size() + 3) {  // the last row is also read four at a time
    std::fill_n(data_.data() + data_.size() - 3, 3, 0.0f);
    Aabb box = Aabb::empty();
    for (const Vec3& v : scene.vertices) box.extend(v);
    center_ = box.center();
    parallelChunks(leaves.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) fill(scene, primitives, leaves[i]);
    });
}

void TriangleBlocks::fill(const Scene& scene, std::span<const uint32_t> primitives,
                          const PrimitiveRange& leaf) {
    float* const block = data_.data() + size_t(kRowCount) * leaf.first;
    for (uint32_t i = 0; i < leaf.count; ++i) {
        const auto set = [&](size_t row, float value) { block[row * leaf.count + i] = value; };
        const uint32_t primitive = primitives[leaf.first + i];
        const uint32_t biased = primitive + kIndexBias;
        std::memcpy(block + i, &biased, sizeof biased);

        const Triangle triangle = scene.triangle(primitive);
        const Vec3* vertices[] = {&triangle.v0, &triangle.v1, &triangle.v2};
        float size = 0;
        for (int v = 0; v < 3; ++v) {
            for (int axis = 0; axis < 3; ++axis)
                set(size_t(kVertexRows + 3 * v + axis), (*vertices[v])[axis]);
            const float s = largestComponent(*vertices[v] - center_);
            size = s > size ? s : size;
        }
        const float error = errorBound(size);
        set(kErrorRow, error);
        set(kReachRow, 4 * largestComponent(bounds(triangle).extent()) * kRoundUp + error);
    }
}

}  // namespace bvhio
