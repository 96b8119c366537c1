#include "scene/instanced_bvh.h"

#include <algorithm>

namespace bvhio {

Scene sceneOfMesh(const Scene& scene, const SceneMesh& mesh) {
    uint32_t first = 0xFFFFFFFF, last = 0;
    for (uint32_t i = 0; i < mesh.triangleCount; ++i) {
        const TriangleIndices& t = scene.triangles[mesh.firstTriangle + i];
        first = std::min({first, t.v0, t.v1, t.v2});
        last = std::max({last, t.v0, t.v1, t.v2});
    }
    AlignedVector<TriangleIndices> triangles(mesh.triangleCount);
    for (uint32_t i = 0; i < mesh.triangleCount; ++i) {
        const TriangleIndices& t = scene.triangles[mesh.firstTriangle + i];
        triangles[i] = {t.v0 - first, t.v1 - first, t.v2 - first};
    }
    const std::span<const Vec3> vertices = scene.vertices;
    return {{scene.vertices.owner(), vertices.subspan(first, last - first + 1)},
            std::move(triangles),
            {{"", 0, mesh.triangleCount}},
            {}};
}

Scene sceneOfInstances(const Scene& scene) {
    AlignedVector<Vec3> vertices;
    AlignedVector<TriangleIndices> triangles;
    for (const InstanceEntry& entry : instanceEntries(scene)) {
        const auto v = uint32_t(vertices.size());
        vertices.push_back(entry.bounds.min);
        vertices.push_back(entry.bounds.max);
        triangles.push_back({v, v + 1, v + 1});
    }
    const auto count = uint32_t(triangles.size());
    return {std::move(vertices), std::move(triangles), {{"", 0, count}}, {}};
}

InstancedBvh mapTrees(const Scene& scene, const InstancedBvh& bvh,
                      const std::function<Bvh(const Scene&, const Bvh&, bool isTop)>& function) {
    InstancedBvh result{function(sceneOfInstances(scene), bvh.top, true), {}};
    for (size_t i = 0; i < bvh.meshes.size(); ++i)
        result.meshes.push_back(function(sceneOfMesh(scene, scene.meshes[i]), bvh.meshes[i], false));
    return result;
}

}  // namespace bvhio
