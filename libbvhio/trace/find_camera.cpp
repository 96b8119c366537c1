#include "trace/find_camera.h"

#include <algorithm>

#include "trace/surface_point.h"

namespace bvhio {
namespace {

/// The camera that looks from the side of `toViewer` and just fits every vertex, with a margin: each side of
/// the view pyramid is pushed outwards as far as some vertex needs, and the eye is where opposite sides meet,
/// taking the farther of the two pairs.
Camera frameObject(const Scene& scene, const Aabb& box, double aspect, Vec3d toViewer) {
    Camera camera;
    camera.fov = 35;
    const Vec3d center(box.center());
    const Vec3d forward = normalize(toViewer) * -1, right = normalize(cross(forward, Vec3d(camera.up)));
    const Vec3d up = cross(right, forward);
    const double tall = halfTangent(camera.fov) * 0.94, wide = tall * aspect;  // 6% stay free around it
    double r = -1e300, l = -1e300, t = -1e300, b = -1e300, nearest = 1e300;
    for (const TriangleIndices& triangle : scene.triangles)
        for (const uint32_t v : {triangle.v0, triangle.v1, triangle.v2}) {
            const Vec3d p = Vec3d(scene.vertices[v]) - center;
            const double x = dot(p, right), y = dot(p, up), z = dot(p, forward);
            r = std::max(r, x - wide * z), l = std::max(l, -x - wide * z);
            t = std::max(t, y - tall * z), b = std::max(b, -y - tall * z);
            nearest = std::min(nearest, z);
        }
    double size = length(Vec3d(box.max) - Vec3d(box.min));
    if (size == 0) size = std::max(1e-3 * length(center), 1e-30);  // all triangles in one point
    const double back = std::max({(r + l) / (2 * wide), (t + b) / (2 * tall), 0.05 * size - nearest});
    const Vec3d aim = center + right * ((r - l) / 2) + up * ((t - b) / 2);
    camera.target = Vec3(aim);
    camera.eye = Vec3(aim - forward * back);
    return camera;
}

}  // namespace

Camera findCamera(const Scene& scene, double aspect, const ClosestHits& closestHits) {
    (void)closestHits;
    return frameObject(scene, triangleBounds(scene), aspect, {0.5, 0.35, 0.8});
}

}  // namespace bvhio
