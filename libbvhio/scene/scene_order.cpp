#include "scene/scene_order.h"

namespace bvhio {

Scene withVerticesByUse(const Scene& scene) {
    constexpr uint32_t kUnnamed = ~0u;  // not the index of a vertex: there are fewer than 2^32
    std::vector<uint32_t> newIndex(scene.vertices.size(), kUnnamed);
    AlignedVector<Vec3> vertices;
    vertices.reserve(scene.vertices.size());
    const auto place = [&](uint32_t vertex) {
        if (newIndex[vertex] == kUnnamed) {
            newIndex[vertex] = uint32_t(vertices.size());
            vertices.push_back(scene.vertices[vertex]);
        }
        return newIndex[vertex];
    };
    AlignedVector<TriangleIndices> triangles(scene.triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i) {
        const TriangleIndices& t = scene.triangles[i];
        triangles[i].v0 = place(t.v0);
        triangles[i].v1 = place(t.v1);
        triangles[i].v2 = place(t.v2);
    }
    for (uint32_t vertex = 0; vertex < scene.vertices.size(); ++vertex) place(vertex);
    Scene result = scene;
    result.vertices = std::move(vertices);
    result.triangles = std::move(triangles);
    return result;
}

ReorderedScene withTrianglesInOrder(const Scene& scene, std::span<const uint32_t> entries) {
    constexpr uint32_t kUnnamed = ~0u;
    std::vector<uint32_t> geometryOf(scene.triangles.size()), next;  // next: the free place of each geometry
    for (uint32_t g = 0; g < scene.geometries.size(); ++g) {
        const Geometry& geometry = scene.geometries[g];
        next.push_back(geometry.firstTriangle);
        for (uint32_t i = 0; i < geometry.triangleCount; ++i) geometryOf[geometry.firstTriangle + i] = g;
    }
    std::vector<uint32_t> newIndex(scene.triangles.size(), kUnnamed);
    AlignedVector<TriangleIndices> triangles(scene.triangles.size());
    std::vector<uint32_t> sourcePrimitives(scene.triangles.size());
    for (const uint32_t triangle : entries) {
        if (newIndex[triangle] != kUnnamed) continue;
        const uint32_t place = next[geometryOf[triangle]]++;
        newIndex[triangle] = place;
        triangles[place] = scene.triangles[triangle];
        sourcePrimitives[place] = scene.primitiveId(triangle).primitive;
    }
    Scene result = scene;
    result.triangles = std::move(triangles);
    result.sourcePrimitives = std::move(sourcePrimitives);
    return {std::move(result), std::move(newIndex)};
}

}  // namespace bvhio
