#include "trace/triangle_blocks.h"

#include <cmath>

#include "core/parallel.h"

namespace bvhio {
namespace {

constexpr float kErrorPerUnit = 25 * 0x1p-24f;
constexpr float kRoundUp = 1 + 0x1p-20f;  // covers the rounding of the bounds themselves
// Beyond this size products of four coordinates overflow: such triangles go to the test in double.
constexpr float kLargest = 1e18f;
// Covers underflow: the square of it is well above the smallest floats.
constexpr float kSmallestError = 0x1p-70f;

float largestComponent(Vec3 v) {
    const float x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    const float xy = x > y ? x : y;
    return xy > z ? xy : z;
}

float errorBound(float size) {
    return size < kLargest ? size * kErrorPerUnit * kRoundUp + kSmallestError
                           : std::numeric_limits<float>::infinity();
}

void setTriangle(TriangleBlock& block, int lane, const Scene& scene, uint32_t primitive, Vec3 center) {
    const Triangle triangle = scene.triangle(primitive);
    const Vec3* vertices[] = {&triangle.v0, &triangle.v1, &triangle.v2};
    float size = 0;
    for (int v = 0; v < 3; ++v) {
        for (int axis = 0; axis < 3; ++axis) block.vertices[v][axis][lane] = (*vertices[v])[axis];
        const float s = largestComponent(*vertices[v] - center);
        size = s > size ? s : size;
    }
    block.error[lane] = errorBound(size);
    block.reach[lane] = 4 * largestComponent(bounds(triangle).extent()) * kRoundUp + block.error[lane];
    block.primitives[lane] = primitive;
}

}  // namespace

TriangleBlocks::TriangleBlocks(const Scene& scene, std::span<const uint32_t> primitives,
                               std::span<const PrimitiveRange> leaves)
    : blockOf_(primitives.size()) {
    Aabb box = Aabb::empty();
    for (const Vec3& v : scene.vertices) box.extend(v);
    center_ = box.center();

    uint32_t count = 0;
    for (const PrimitiveRange& leaf : leaves) {
        blockOf_[leaf.first] = count;
        count += (leaf.count + 3) / 4;
    }
    blocks_.resize(count);
    parallelChunks(leaves.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const PrimitiveRange leaf = leaves[i];
            TriangleBlock* block = &blocks_[blockOf_[leaf.first]];
            for (uint32_t k = 0; k < (leaf.count + 3) / 4 * 4; ++k) {
                // Lanes past the end repeat the last triangle; their answers are masked out.
                const uint32_t entry = leaf.first + (k < leaf.count ? k : leaf.count - 1);
                setTriangle(block[k / 4], int(k % 4), scene, primitives[entry], center_);
            }
        }
    });
}

float TriangleBlocks::rayError(Vec3 origin) const {
    return errorBound(largestComponent(origin - center_));
}

}  // namespace bvhio
