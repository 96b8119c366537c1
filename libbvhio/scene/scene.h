// A scene as a BVH sees it: triangles with stable ids.
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

/// A run of triangles that came from one mesh primitive of one glTF node, in scene order, or the only one of
/// an OBJ, PLY, STL or DRC file. Points and lines give a geometry without triangles, so that geometries have
/// the same numbers as in the source.
struct Geometry {
    std::string name;
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    bool operator==(const Geometry&) const = default;
};

/// A run of geometries that instances place together. It has at least one triangle.
struct SceneMesh {
    uint32_t firstGeometry = 0, geometryCount = 0;
    uint32_t firstTriangle = 0, triangleCount = 0;
    bool operator==(const SceneMesh&) const = default;
};

/// A mesh that is placed in the world. `firstPrimitive` and `firstGeometry` are the numbers of its first
/// triangle and its first geometry in hits. Hits number them as if the triangles of every instance were
/// copied to their places.
struct SceneInstance {
    Affine objectToWorld = kIdentityAffine;
    uint32_t mesh = 0;
    uint32_t firstPrimitive = 0, firstGeometry = 0;
    bool operator==(const SceneInstance&) const = default;
};

/// Indexed triangles. Every coordinate is finite and never -0 (importers turn -0 into +0, so that minima and
/// maxima do not depend on the order of their operands). Every index is in range. There is at least one
/// triangle, and fewer than 2^31. Geometries are in order, and their runs cover `triangles` exactly.
///
/// In a plain scene, which has no instances, triangles are in the world's space. In an instanced scene they
/// are in the spaces of their meshes, whose runs are in order and cover `geometries` and `triangles` exactly.
/// Each instance has an invertible transform, and all instances together have fewer than 2^31 triangles. A
/// triangle of an instance is a *primitive*; primitives are numbered through all instances. In a plain scene
/// the primitives are the triangles.
struct Scene {
    SharedArray<Vec3> vertices;
    SharedArray<TriangleIndices> triangles;
    std::vector<Geometry> geometries;
    /// For each triangle, its number within its geometry in the source. Empty if no triangles were dropped or
    /// reordered.
    SharedArray<uint32_t> sourcePrimitives;
    std::vector<SceneMesh> meshes = {};
    std::vector<SceneInstance> instances = {};

    bool isInstanced() const { return !instances.empty(); }
    Triangle triangle(size_t i) const {
        const TriangleIndices& t = triangles[i];
        return {vertices[t.v0], vertices[t.v1], vertices[t.v2]};
    }
    Aabb boundsOf(const SceneMesh& mesh) const;

    /// Returns the number of primitives: the last number of a primitive in hits, plus 1.
    uint32_t primitiveCount() const;
    /// Returns the number of geometries as hits number them: those of every instance.
    uint32_t placedGeometryCount() const;
    /// Returns the number of the instance that has the primitive. For instanced scenes only.
    uint32_t instanceOf(uint32_t primitive) const;
    /// Returns the index of the primitive's triangle in `triangles`.
    uint32_t triangleOf(uint32_t primitive) const;
    /// Returns the primitive's triangle in the world, with vertices rounded to float.
    Triangle placedTriangle(uint32_t primitive) const;
    /// How hit files and reports name a primitive: its geometry, its number there in source order, and its
    /// instance (0 in a plain scene).
    struct PrimitiveId {
        uint32_t geometry, primitive, instance;
    };
    PrimitiveId primitiveId(uint32_t primitive) const;
};

inline constexpr uint64_t kMaxPrimitives = (uint64_t(1) << 31) - 1;

/// Sets the runs of meshes from their geometry counts, and the first primitives of instances from their
/// meshes, in order. Throws Error{unsupported} if the instances have 2^31 or more triangles in all.
void numberInstances(Scene& scene);

}  // namespace bvhio
