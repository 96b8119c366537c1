#include "rays/surface_point.h"

#include <cmath>

#include "core/parallel.h"

namespace bvhio {

SurfacePoint surfacePoint(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Triangle t = scene.placedTriangle(hit.primitive);
    const double u = hit.u, v = hit.v;
    const Vec3d point = Vec3d(t.v0) * (1 - u - v) + Vec3d(t.v1) * u + Vec3d(t.v2) * v;
    Vec3d normal = triangleNormal(t);
    const Vec3d viewer = Vec3d(ray.direction) * -1;
    if (dot(normal, viewer) < 0) normal = normal * -1;
    if (dot(normal, normal) == 0) normal = normalize(viewer);
    const Aabb box = bounds(t);
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest =
            std::fmax(largest, std::fmax(std::fabs(double(box.min[axis])), std::fabs(double(box.max[axis]))));
    if (scene.isInstanced()) {
        // The intersection test works in the mesh's space, where the mesh may be far from its place in the
        // world.
        const SceneInstance& instance = scene.instances[scene.instanceOf(hit.primitive)];
        const uint32_t triangle =
            scene.meshes[instance.mesh].firstTriangle + hit.primitive - instance.firstPrimitive;
        for (const double sum : placedMagnitude(instance.objectToWorld, bounds(scene.triangle(triangle))))
            largest = std::fmax(largest, sum);
    }
    return {clampToFloat(point + normal * (largest * 0x1p-19)), normal};
}

Aabb triangleBounds(const Scene& scene) {
    Aabb box = Aabb::empty();
    if (!scene.isInstanced()) {
        for (size_t i = 0; i < scene.triangles.size(); ++i) box.extend(bounds(scene.triangle(i)));
        return box;
    }
    std::vector<Aabb> boxes(scene.instances.size());
    parallelChunks(boxes.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            boxes[i] = Aabb::empty();
            forEachPlacedVertex(scene, scene.instances[i], [&](Vec3 v) { boxes[i].extend(v); });
        }
    });
    for (const Aabb& part : boxes) box.extend(part);
    return box;
}

}  // namespace bvhio
