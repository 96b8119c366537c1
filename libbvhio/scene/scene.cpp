#include "scene/scene.h"

#include <algorithm>

#include "core/error.h"

namespace bvhio {

Aabb Scene::boundsOf(const SceneMesh& mesh) const {
    Aabb box = Aabb::empty();
    for (uint32_t i = 0; i < mesh.triangleCount; ++i) box.extend(bounds(triangle(mesh.firstTriangle + i)));
    return box;
}

uint32_t Scene::primitiveCount() const {
    if (!isInstanced()) return uint32_t(triangles.size());
    const SceneInstance& last = instances.back();
    return last.firstPrimitive + meshes[last.mesh].triangleCount;
}

uint32_t Scene::placedGeometryCount() const {
    if (!isInstanced()) return uint32_t(geometries.size());
    const SceneInstance& last = instances.back();
    return last.firstGeometry + meshes[last.mesh].geometryCount;
}

uint32_t Scene::instanceOf(uint32_t primitive) const {
    const auto after = std::upper_bound(
        instances.begin(), instances.end(), primitive,
        [](uint32_t p, const SceneInstance& instance) { return p < instance.firstPrimitive; });
    return uint32_t(after - instances.begin()) - 1;
}

uint32_t Scene::triangleOf(uint32_t primitive) const {
    if (!isInstanced()) return primitive;
    const SceneInstance& instance = instances[instanceOf(primitive)];
    return meshes[instance.mesh].firstTriangle + primitive - instance.firstPrimitive;
}

Triangle Scene::placedTriangle(uint32_t primitive) const {
    if (!isInstanced()) return triangle(primitive);
    const SceneInstance& instance = instances[instanceOf(primitive)];
    const Triangle t = triangle(meshes[instance.mesh].firstTriangle + primitive - instance.firstPrimitive);
    const Affine& m = instance.objectToWorld;
    return {place(m, t.v0), place(m, t.v1), place(m, t.v2)};
}

Scene::PrimitiveId Scene::primitiveId(uint32_t primitive) const {
    uint32_t triangle = primitive, firstGeometry = 0, instance = 0;
    if (isInstanced()) {
        instance = instanceOf(primitive);
        const SceneInstance& placed = instances[instance];
        const SceneMesh& mesh = meshes[placed.mesh];
        triangle = mesh.firstTriangle + primitive - placed.firstPrimitive;
        firstGeometry = placed.firstGeometry - mesh.firstGeometry;
    }
    // The last geometry that starts at or before the triangle. Empty geometries have the same start as the
    // next one, which owns the triangle.
    const auto after = std::upper_bound(geometries.begin(), geometries.end(), triangle,
                                        [](uint32_t t, const Geometry& g) { return t < g.firstTriangle; });
    const auto geometry = uint32_t(after - geometries.begin()) - 1;
    const uint32_t number =
        sourcePrimitives.empty() ? triangle - geometries[geometry].firstTriangle : sourcePrimitives[triangle];
    return {geometry + firstGeometry, number, instance};
}

void numberInstances(Scene& scene) {
    uint32_t geometry = 0, triangle = 0;
    for (SceneMesh& mesh : scene.meshes) {
        mesh.firstGeometry = geometry;
        mesh.firstTriangle = triangle;
        geometry += mesh.geometryCount;
        mesh.triangleCount = 0;
        for (uint32_t i = mesh.firstGeometry; i < geometry; ++i)
            mesh.triangleCount += scene.geometries[i].triangleCount;
        triangle += mesh.triangleCount;
    }
    uint64_t primitive = 0;
    for (SceneInstance& instance : scene.instances) {
        instance.firstPrimitive = uint32_t(primitive);
        primitive += scene.meshes[instance.mesh].triangleCount;
        if (primitive > kMaxPrimitives)
            throw Error(ErrorKind::unsupported, "the scene's instances have more than " +
                                                    std::to_string(kMaxPrimitives) + " triangles in all");
    }
}

}  // namespace bvhio
