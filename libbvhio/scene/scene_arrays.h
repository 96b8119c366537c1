// The door for scenes that come from a program's own arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.h"

namespace bvhio {

/// A scene as a program has it. Nothing here is trusted.
struct SceneArrays {
    const void* vertices = nullptr;  // of three floats each
    size_t vertexCount = 0;
    size_t vertexStride = sizeof(Vec3);  // bytes from one vertex to the next; any alignment
    std::span<const uint32_t> indices;   // three for each triangle

    struct Part {
        std::string name;
        uint32_t triangleCount = 0;
    };
    std::span<const Part> geometries;  // in order; empty: one without a name for all triangles
    std::span<const uint32_t>
        sourcePrimitives;  // as in Scene; empty: triangles are numbered in each geometry

    // Only for instanced scenes.
    std::span<const uint32_t> meshes;  // how many geometries each has
    struct Placed {
        uint32_t mesh = 0;
        Affine objectToWorld = kIdentityAffine;
    };
    std::span<const Placed> instances;
};

/// Copies the arrays to a valid scene; -0 becomes +0. Throws Error: invalid when there are no triangles, an
/// index is out of range, a coordinate is not finite, counts disagree or a transform cannot be inverted;
/// unsupported when there is too much of something; usage when the arrays themselves make no sense.
Scene sceneFromArrays(const SceneArrays& arrays);

}  // namespace bvhio
