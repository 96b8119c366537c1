// Closest hits by trying every triangle in double: slow, and independent of the library's own intersection
// test.
#pragma once

#include "rays/ray_sets.h"
#include "rays/surface_point.h"

namespace bvhio {

inline std::vector<Hit> bruteHits(const Scene& scene, std::span<const Ray> rays) {
    std::vector<Hit> hits(rays.size());
    for (size_t i = 0; i < rays.size(); ++i)
        for (uint32_t k = 0; k < scene.triangles.size(); ++k) {
            const Triangle t = scene.triangle(k);
            const Vec3d e1 = Vec3d(t.v1) - Vec3d(t.v0), e2 = Vec3d(t.v2) - Vec3d(t.v0), d(rays[i].direction);
            const Vec3d p = cross(d, e2), s = Vec3d(rays[i].origin) - Vec3d(t.v0), q = cross(s, e1);
            const double det = dot(e1, p);
            if (det == 0) continue;
            const double u = dot(s, p) / det, v = dot(d, q) / det, distance = dot(e2, q) / det;
            if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
            if (!(distance >= rays[i].tMin && distance <= rays[i].tMax && distance < hits[i].t)) continue;
            hits[i] = {float(distance), float(u), float(v), k};
        }
    return hits;
}

/// A scene of one geometry.
inline Scene makeScene(std::vector<Vec3> vertices, std::vector<TriangleIndices> triangles) {
    const auto count = uint32_t(triangles.size());
    return {std::move(vertices), std::move(triangles), {{"", 0, count}}, {}};
}

/// A unit ball of 20 * 4^2 triangles facing outwards, stretched by `scale` and moved to `center`.
inline Scene makeBall(float scale, Vec3 center) {
    const float g = 1.618034f;
    std::vector<Vec3d> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    std::vector<TriangleIndices> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int round = 0; round < 2; ++round) {
        std::vector<TriangleIndices> finer;
        const auto middle = [&](uint32_t a, uint32_t b) {
            points.push_back((points[a] + points[b]) * 0.5);
            return uint32_t(points.size() - 1);
        };
        for (const auto& [a, b, c] : faces) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    std::vector<Vec3> vertices;
    for (const Vec3d& p : points) vertices.push_back(Vec3(Vec3d(center) + normalize(p) * scale));
    return makeScene(std::move(vertices), std::move(faces));
}

inline ClosestHits bruteForce(const Scene& scene) {
    return [&scene](std::span<const Ray> rays) { return bruteHits(scene, rays); };
}

}  // namespace bvhio
