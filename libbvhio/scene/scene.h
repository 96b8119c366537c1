// A scene as the BVH sees it: triangles with stable ids.
#pragma once

#include <string>
#include <vector>

#include "core/shared_array.h"
#include "core/triangle.h"
#include "scene/instance.h"

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

/// A run of geometries that instances place together; it has at least one triangle.
struct SceneMesh {
    uint32_t firstGeometry = 0, geometryCount = 0;
    uint32_t firstTriangle = 0, triangleCount = 0;
    bool operator==(const SceneMesh&) const = default;
};

/// A mesh where it stands. `firstPrimitive` and `firstGeometry` are the numbers that its first triangle and
/// its first geometry have in hits: those of the same scene with every instance's triangles copied to their
/// place.
struct SceneInstance {
    Affine objectToWorld = kIdentityAffine;
    uint32_t mesh = 0;
    uint32_t firstPrimitive = 0, firstGeometry = 0;
    bool operator==(const SceneInstance&) const = default;
};

/// Indexed triangles. Every coordinate is finite and never -0 (importers turn it into +0, so that minima and
/// maxima do not depend on the order they are taken in); every index is in range; there is at least one
/// triangle, and fewer than 2^31. Geometries are in order and their runs cover `triangles` exactly.
///
/// In a plain scene, one without instances, they stand in the world as they are. In an instanced scene they
/// are in the spaces of their meshes, whose runs are in order and cover `geometries` and `triangles` exactly;
/// each instance has a transform that can be inverted, and all of them together have fewer than 2^31
/// triangles. A triangle of an instance is a *primitive*, numbered through all instances; in a plain scene
/// primitives are the triangles.
struct Scene {
    SharedArray<Vec3> vertices;
    SharedArray<TriangleIndices> triangles;
    std::vector<Geometry> geometries;
    /// The triangle's number within its geometry in the source, where triangles were dropped; empty when none
    /// were.
    SharedArray<uint32_t> sourcePrimitives;
    std::vector<SceneMesh> meshes = {};
    std::vector<SceneInstance> instances = {};

    bool isInstanced() const { return !instances.empty(); }
    Triangle triangle(size_t i) const {
        const TriangleIndices& t = triangles[i];
        return {vertices[t.v0], vertices[t.v1], vertices[t.v2]};
    }
    Aabb boundsOf(const SceneMesh& mesh) const;

    /// Primitives: what hits number, and what they call the last one + 1.
    uint32_t primitiveCount() const;
    /// Geometries as hits number them.
    uint32_t placedGeometryCount() const;
    /// The number of the instance that has the primitive; of an instanced scene.
    uint32_t instanceOf(uint32_t primitive) const;
    /// The primitive's triangle where it stands in the world, vertices rounded to float.
    Triangle placedTriangle(uint32_t primitive) const;
    /// What hit files and reports call a primitive: which geometry, which triangle of it in source order, and
    /// which instance (0 in a plain scene).
    struct PrimitiveId {
        uint32_t geometry, primitive, instance;
    };
    PrimitiveId primitiveId(uint32_t primitive) const;
};

inline constexpr uint64_t kMaxPrimitives = (uint64_t(1) << 31) - 1;

/// Numbers meshes' runs from their geometry counts and instances' primitives from their meshes, in order.
/// Throws Error{unsupported} when the instances have 2^31 triangles or more in all.
void numberInstances(Scene& scene);

}  // namespace bvhio
