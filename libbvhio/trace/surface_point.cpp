#include "trace/surface_point.h"

#include <cmath>

namespace bvhio {

SurfacePoint surfacePoint(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Triangle t = scene.triangle(hit.primitive);
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
    return {clampToFloat(point + normal * (largest * 0x1p-19)), normal};
}

Aabb triangleBounds(const Scene& scene) {
    Aabb box = Aabb::empty();
    for (size_t i = 0; i < scene.triangles.size(); ++i) box.extend(bounds(scene.triangle(i)));
    return box;
}

}  // namespace bvhio
