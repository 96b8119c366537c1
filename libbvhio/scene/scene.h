// A scene as the BVH sees it: triangles with stable ids.
#pragma once

#include <string>
#include <vector>

#include "core/shared_array.h"
#include "core/triangle.h"

namespace bvhio {

/// Three indices into Scene::vertices; 12 bytes, plain data, stored as is in files.
struct TriangleIndices {
    uint32_t v0, v1, v2;
    bool operator==(const TriangleIndices&) const = default;
};
static_assert(sizeof(TriangleIndices) == 12);

/// A run of triangles that came from one mesh primitive of one glTF node, in scene order, or the one of an
/// OBJ, PLY, STL or DRC file. Points and lines make a geometry without triangles, so that numbers match the
/// source's.
struct Geometry {
    std::string name;
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    bool operator==(const Geometry&) const = default;
};

/// Indexed triangles in world space. Every coordinate is finite and never -0 (importers turn it into +0, so
/// that minima and maxima do not depend on the order they are taken in); every index is in range; there is at
/// least one triangle, and fewer than 2^31. Geometries are in order and their runs cover `triangles` exactly.
struct Scene {
    SharedArray<Vec3> vertices;
    SharedArray<TriangleIndices> triangles;
    std::vector<Geometry> geometries;
    /// The triangle's number within its geometry in the source, where triangles were dropped; empty when none
    /// were.
    SharedArray<uint32_t> sourcePrimitives;

    Triangle triangle(size_t i) const {
        const TriangleIndices& t = triangles[i];
        return {vertices[t.v0], vertices[t.v1], vertices[t.v2]};
    }
    /// What hit files and reports call a triangle: which geometry, and which triangle of it in source order.
    struct PrimitiveId {
        uint32_t geometry, primitive;
    };
    PrimitiveId primitiveId(uint32_t triangle) const;
};

}  // namespace bvhio
