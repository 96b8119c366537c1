// Makes a valid scene from a program's own arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.h"

namespace bvhio {

/// A scene in a program's own arrays. sceneFromArrays checks all of it.
struct SceneArrays {
    const void* vertices = nullptr;  // of three floats each
    size_t vertexCount = 0;
    size_t vertexStride = sizeof(Vec3);  // bytes from one vertex to the next; any alignment
    std::span<const uint32_t> indices;   // three for each triangle

    struct Part {
        std::string name;
        uint32_t triangleCount = 0;
    };
    std::span<const Part> geometries;  // in order; empty: one geometry without a name for all triangles
    // As in Scene. Empty: each triangle's source number is its index in its geometry.
    std::span<const uint32_t> sourcePrimitives;

    // Only for instanced scenes.
    std::span<const uint32_t> meshes;  // the number of geometries of each mesh
    struct Placed {
        uint32_t mesh = 0;
        Affine objectToWorld = kIdentityAffine;
    };
    std::span<const Placed> instances;
};

/// Copies the arrays to a valid scene; -0 becomes +0. Throws Error: invalid if there are no triangles, an
/// index is out of range, a coordinate is not finite, counts disagree or a transform cannot be inverted;
/// unsupported if a count exceeds the format's limit; usage if a stride or an array's length makes no sense.
Scene sceneFromArrays(const SceneArrays& arrays);

}  // namespace bvhio
