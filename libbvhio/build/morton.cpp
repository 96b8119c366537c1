// Morton codes (Morton 1966; as a BVH's order: Lauterbach et al. 2009, "Fast BVH construction on GPUs").

#include "build/morton.h"

#include <algorithm>
#include <vector>

#include "build/morton_sort.h"
#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/morton.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/boxes_simd.h"

#ifndef BVHIO_BUILD_MORTON_CPP
#define BVHIO_BUILD_MORTON_CPP
namespace bvhio {
namespace {

/// Maps the doubled centre of a box to one of 2^21 cells per axis, by (centre - origin) * factor.
struct MortonGrid {
    float scale;  // of coordinates: their areaScale
    alignas(16) float origin[4];
    alignas(16) float factor[4];

    /// Makes a grid over `bounds`, which are not scaled.
    explicit MortonGrid(const Box& bounds) : scale(areaScale(bounds)), origin{}, factor{} {
        float longest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // The largest scale, 2^127, cannot be doubled.
            origin[axis] = 0 - 2 * (scale * bounds.negatedMin[axis]);
            longest = std::max(longest, 2 * (scale * bounds.max[axis]) - origin[axis]);
        }
        if (longest > 0x1p-100f) std::fill_n(factor, 3, kCells / longest);
    }
    static constexpr float kCells = 0x1p21f;
};

}  // namespace
}  // namespace bvhio
#endif

HWY_BEFORE_NAMESPACE();
namespace bvhio {
namespace HWY_NAMESPACE {
namespace {

/// Spreads the low 21 bits of each lane to every third bit.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V spread(D d, V v) {
    v = hn::And(hn::Or(v, hn::ShiftLeft<32>(v)), hn::Set(d, 0x001f00000000ffff));
    v = hn::And(hn::Or(v, hn::ShiftLeft<16>(v)), hn::Set(d, 0x001f0000ff0000ff));
    v = hn::And(hn::Or(v, hn::ShiftLeft<8>(v)), hn::Set(d, 0x100f00f00f00f00f));
    v = hn::And(hn::Or(v, hn::ShiftLeft<4>(v)), hn::Set(d, 0x10c30c30c30c30c3));
    return hn::And(hn::Or(v, hn::ShiftLeft<2>(v)), hn::Set(d, 0x1249249249249249));
}

/// Computes the codes of triangles [begin, end), from the highest bit down. Returns the bounds of their
/// scaled boxes.
Box encodeSome(const Scene& scene, size_t begin, size_t end, const MortonGrid& grid, uint64_t* codes) {
    constexpr size_t kBlock = 64;
    alignas(64) uint32_t cells[kBlock][4] = {};
    const Four d;
    const hn::Rebind<int32_t, Four> di;
    const hn::CappedTag<uint64_t, 8> d64;
    const hn::Rebind<uint32_t, decltype(d64)> d32;
    const FourV origin = hn::Load(d, grid.origin), factor = hn::Load(d, grid.factor),
                most = hn::Set(d, MortonGrid::kCells - 1);
    const TriangleBoxes boxes(scene, grid.scale);
    BoxV all = BoxV::empty();
    for (size_t block = begin; block < end; block += kBlock) {
        // Compute the cells of a block of triangles, and prefetch the next block.
        const size_t count = std::min(kBlock, end - block);
        const size_t nextEnd = std::min(end, block + 2 * kBlock);
        for (size_t i = block + count; i < nextEnd; ++i) boxes.prefetch(scene.triangles[i]);
        for (size_t i = 0; i < count; ++i) {
            const BoxV box = boxes(scene.triangles[block + i]);
            all = unite(all, box);
            const FourV cell = hn::Mul(hn::Sub(hn::Sub(box.high(), box.low()), origin), factor);
            hn::Store(hn::BitCast(FourU(), hn::ConvertTo(di, hn::Max(hn::Min(cell, most), hn::Zero(d)))),
                      FourU(), cells[i]);
        }

        // Interleave the bits of x, y and z.
        alignas(64) uint64_t blockCodes[kBlock];
        for (size_t i = 0; i < count; i += hn::Lanes(d64)) {
            hn::Vec<decltype(d32)> x, y, z, unused;
            hn::LoadInterleaved4(d32, cells[i], x, y, z, unused);
            const auto spreadX = spread(d64, hn::PromoteTo(d64, x)),
                       spreadY = spread(d64, hn::PromoteTo(d64, y)),
                       spreadZ = spread(d64, hn::PromoteTo(d64, z));
            hn::Store(hn::Or(hn::Or(hn::ShiftLeft<3>(spreadX), hn::ShiftLeft<2>(spreadY)),
                             hn::ShiftLeft<1>(spreadZ)),
                      d64, blockCodes + i);
        }
        std::copy_n(blockCodes, count, codes + block);
    }
    Box bounds;
    all.store(bounds.negatedMin);
    return bounds;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bvhio
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bvhio {
namespace {

HWY_EXPORT(encodeSome);

Box boundsOfVertices(const Scene& scene) {
    return boundsOfChunks(scene.vertices.size(), [&](size_t begin, size_t end) {
        Box bounds = Box::empty();
        for (size_t i = begin; i < end; ++i) bounds.extendPoint(&scene.vertices[i].x);
        return bounds;
    });
}

Box boundsOfTriangles(const Scene& scene) {
    return boundsOfChunks(scene.triangles.size(), [&](size_t begin, size_t end) {
        Box bounds = Box::empty();
        for (size_t i = begin; i < end; ++i)
            for (const uint32_t v : {scene.triangles[i].v0, scene.triangles[i].v1, scene.triangles[i].v2})
                bounds.extendPoint(&scene.vertices[v].x);
        return bounds;
    });
}

}  // namespace

MortonOrder mortonOrder(const Scene& scene) {
    const size_t count = scene.triangles.size();
    Buffer<uint64_t> codes(count);
    const auto encode = [&](const MortonGrid& grid) {
        return boundsOfChunks(count, [&](size_t begin, size_t end) {
            return HWY_DYNAMIC_DISPATCH(encodeSome)(scene, begin, end, grid, codes.data());
        });
    };
    // The bounds of the vertices are faster to compute than those of the triangles, and equal unless vertices
    // are unused. If they are too large, start again with the bounds of the triangles.
    MortonGrid grid(boundsOfVertices(scene));
    const Box used = encode(grid);
    const float usedExtent = std::max({used.extent(0), used.extent(1), used.extent(2)});
    if (usedExtent * grid.factor[0] < 0.5f * MortonGrid::kCells / 2) {
        grid = MortonGrid(boundsOfTriangles(scene));
        encode(grid);
    }
    MortonOrder order{Buffer<uint32_t>(count), Buffer<uint8_t>(count), grid.scale};
    sortCodes({codes.data(), count}, order.triangles.data(), order.levels.data());
    return order;
}

}  // namespace bvhio
#endif
