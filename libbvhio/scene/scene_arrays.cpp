#include "scene/scene_arrays.h"

#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/check_scene.h"

namespace bvhio {
namespace {

constexpr size_t kGrain = 1 << 15;

AlignedVector<Vec3> copyVertices(const SceneArrays& arrays) {
    AlignedVector<Vec3> vertices(arrays.vertexCount);
    const auto* bytes = static_cast<const std::byte*>(arrays.vertices);
    parallelChunks(vertices.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            std::memcpy(&vertices[i], bytes + i * arrays.vertexStride, sizeof(Vec3));
            vertices[i] = vertices[i] + Vec3{};  // -0 + 0 is +0
        }
    });
    return vertices;
}

void checkSizes(const SceneArrays& arrays) {
    if (arrays.vertexStride < sizeof(Vec3))
        throw Error(ErrorKind::usage, "vertices are " + std::to_string(arrays.vertexStride) +
                                          " bytes apart, but a vertex takes 12");
    if (arrays.indices.size() % 3 != 0)
        throw Error(ErrorKind::usage,
                    std::to_string(arrays.indices.size()) + " indices are not three for each triangle");
    if (arrays.indices.empty()) throw Error(ErrorKind::invalid, "the scene has no triangles");
    if (arrays.indices.size() / 3 > kMaxPrimitives ||
        arrays.vertexCount > std::numeric_limits<uint32_t>::max())
        throw Error(ErrorKind::unsupported,
                    "the scene has more than " + std::to_string(kMaxPrimitives) + " triangles or " +
                        std::to_string(std::numeric_limits<uint32_t>::max()) + " vertices");
}

}  // namespace

Scene sceneFromArrays(const SceneArrays& arrays) {
    checkSizes(arrays);
    Scene scene;
    scene.vertices = copyVertices(arrays);
    AlignedVector<TriangleIndices> triangles(arrays.indices.size() / 3);
    std::memcpy(triangles.data(), arrays.indices.data(), arrays.indices.size_bytes());
    scene.triangles = std::move(triangles);

    uint64_t first = 0;
    for (const SceneArrays::Part& part : arrays.geometries) {
        scene.geometries.push_back({part.name, uint32_t(first), part.triangleCount});
        first += part.triangleCount;
        if (first > scene.triangles.size()) break;  // before the sum wraps; checkScene refuses it
    }
    if (arrays.geometries.empty()) scene.geometries.push_back({"", 0, uint32_t(scene.triangles.size())});
    if (!arrays.sourcePrimitives.empty())
        scene.sourcePrimitives =
            AlignedVector<uint32_t>(arrays.sourcePrimitives.begin(), arrays.sourcePrimitives.end());

    uint64_t geometries = 0;
    for (const uint32_t count : arrays.meshes) geometries += count;
    if (geometries > scene.geometries.size())
        throw Error(ErrorKind::invalid, "the scene has " + std::to_string(scene.geometries.size()) +
                                            " geometries, but its meshes have " + std::to_string(geometries));
    for (const uint32_t count : arrays.meshes) scene.meshes.push_back({0, count, 0, 0});
    for (const SceneArrays::Placed& placed : arrays.instances) {
        if (placed.mesh >= scene.meshes.size())
            throw Error(ErrorKind::invalid, "instance " + std::to_string(scene.instances.size()) +
                                                " refers to mesh " + std::to_string(placed.mesh) +
                                                ", but there are only " +
                                                std::to_string(scene.meshes.size()));
        scene.instances.push_back({placed.objectToWorld, placed.mesh, 0, 0});
    }
    numberInstances(scene);
    // Hits number the geometries of all instances in one sequence.
    uint64_t geometry = 0;
    for (SceneInstance& instance : scene.instances) {
        instance.firstGeometry = uint32_t(geometry);
        geometry += scene.meshes[instance.mesh].geometryCount;
    }
    checkScene(scene);
    return scene;
}

}  // namespace bvhio
