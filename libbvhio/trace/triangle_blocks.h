// Triangles rearranged for tracing: blocks of four, in leaf order, tested four at a time.
#pragma once

#include <span>
#include <vector>

#include "compress/form_concept.h"
#include "scene/scene.h"

namespace bvhio {

/// Four triangles, vertex by vertex and axis by axis, and for each what bounds the rounding errors of a test
/// in float:
///
/// The test of hitTriangle in float, u = 2^-24 being half a unit in the last place, has sheared coordinates
/// that are off by at most 6.1 u M, where M bounds every coordinate of the triangle relative to the ray's
/// origin. When hitTriangle accepts, the sheared coordinates are at most 2 L, where L is the longest side of
/// the triangle's box; so each edge function, a difference of two products of them, is off by at most 12 e L
/// + 2 e^2 with e = 6.1 u M. `error` and `reach` give a larger bound with two additions and a product: (error
/// + rayError) * (reach + rayError), error + rayError = 25 u M, reach = 4 L + error. M is split at a centre c
/// that all blocks share: |v - o| <= |v - c| + |o - c|, the first term in `error`, the second in `rayError`.
struct alignas(64) TriangleBlock {
    float vertices[3][3][4];  // [vertex][axis][lane]
    float error[4], reach[4];
    uint32_t primitives[4];  // index into Scene::triangles

    Triangle triangle(int lane) const {
        const auto vertex = [&](int v) {
            return Vec3{vertices[v][0][lane], vertices[v][1][lane], vertices[v][2][lane]};
        };
        return {vertex(0), vertex(1), vertex(2)};
    }
};
static_assert(sizeof(TriangleBlock) == 192);

/// The triangles of every leaf of a form, each leaf starting a block of its own.
class TriangleBlocks {
  public:
    /// `leaves` are the form's leaves, in any order; `primitives` its primitive array.
    TriangleBlocks(const Scene& scene, std::span<const uint32_t> primitives,
                   std::span<const PrimitiveRange> leaves);

    const TriangleBlock* leaf(uint32_t firstPrimitive) const {
        return blocks_.data() + blockOf_[firstPrimitive];
    }
    /// The ray's share of the error bound, for rays from `origin`.
    float rayError(Vec3 origin) const;
    size_t bytes() const {
        return blocks_.size() * sizeof(TriangleBlock) + blockOf_.size() * sizeof(uint32_t);
    }

  private:
    Vec3 center_;
    AlignedVector<TriangleBlock> blocks_;
    std::vector<uint32_t> blockOf_;  // by the leaf's first entry in the primitive array
};

}  // namespace bvhio
