// The point where a ray hit a surface, precise enough to start other rays there.
#pragma once

#include "core/ray.h"
#include "rays/vec3d.h"
#include "scene/scene.h"

namespace bvhio {

/// A point from which rays into the half space of `normal` do not hit the surface that they leave.
struct SurfacePoint {
    Vec3 origin;
    Vec3d normal;  // unit, of the flat triangle, towards the viewer
};

/// Returns the unit normal of a triangle by its winding, or zero for a triangle without area.
inline Vec3d triangleNormal(const Triangle& t) {
    return normalize(cross(Vec3d(t.v1) - Vec3d(t.v0), Vec3d(t.v2) - Vec3d(t.v0)));
}

/// Returns the point of a hit (not a miss), from its barycentric weights. Unlike origin + t * direction, it
/// does not drift off the triangle with distance. It is lifted along the normal by 2^-19 of the triangle's
/// largest coordinate: 32 times the distance by which rounding to float may move it, and 32 times the error
/// of the intersection test of a ray that starts there.
SurfacePoint surfacePoint(const Scene& scene, const Ray& ray, const Hit& hit);

/// Calls function(v) with the vertices of the instance's triangles, placed in the world.
template <class Function>
void forEachPlacedVertex(const Scene& scene, const SceneInstance& instance, const Function& function) {
    const SceneMesh& mesh = scene.meshes[instance.mesh];
    for (uint32_t i = 0; i < mesh.triangleCount; ++i) {
        const TriangleIndices& t = scene.triangles[mesh.firstTriangle + i];
        for (const uint32_t v : {t.v0, t.v1, t.v2})
            function(place(instance.objectToWorld, scene.vertices[v]));
    }
}

/// Returns the box of all triangles in the world.
Aabb triangleBounds(const Scene& scene);

}  // namespace bvhio
