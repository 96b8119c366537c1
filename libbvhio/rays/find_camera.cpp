#include "rays/find_camera.h"

#include <algorithm>

#include "rays/surface_point.h"

namespace bvhio {
namespace {

/// Returns the camera that looks from the direction `toViewer` and just fits every vertex, with a margin.
/// Each side of the view pyramid is pushed outwards until it includes every vertex. Opposite sides meet in
/// two lines, and the eye is as far away as the farther of the two.
Camera frameObject(const Scene& scene, const Aabb& box, double aspect, Vec3d toViewer) {
    Camera camera;
    camera.fov = 35;
    const Vec3d center(box.center());
    const Vec3d forward = normalize(toViewer) * -1, right = normalize(cross(forward, Vec3d(camera.up)));
    const Vec3d up = cross(right, forward);
    const double tall = halfTangent(camera.fov) * 0.94, wide = tall * aspect;  // a margin of 6%
    double r = -1e300, l = -1e300, t = -1e300, b = -1e300, nearest = 1e300;
    const auto fit = [&](Vec3 vertex) {
        const Vec3d p = Vec3d(vertex) - center;
        const double x = dot(p, right), y = dot(p, up), z = dot(p, forward);
        r = std::max(r, x - wide * z), l = std::max(l, -x - wide * z);
        t = std::max(t, y - tall * z), b = std::max(b, -y - tall * z);
        nearest = std::min(nearest, z);
    };
    for (const SceneInstance& instance : scene.instances) forEachPlacedVertex(scene, instance, fit);
    if (!scene.isInstanced())
        for (const TriangleIndices& triangle : scene.triangles)
            for (const uint32_t v : {triangle.v0, triangle.v1, triangle.v2}) fit(scene.vertices[v]);
    double size = length(Vec3d(box.max) - Vec3d(box.min));
    if (size == 0) size = std::max(1e-3 * length(center), 1e-30);  // all triangles in one point
    const double back = std::max({(r + l) / (2 * wide), (t + b) / (2 * tall), 0.05 * size - nearest});
    const Vec3d aim = center + right * ((r - l) / 2) + up * ((t - b) / 2);
    camera.target = clampToFloat(aim);
    camera.eye = clampToFloat(aim - forward * back);
    return camera;
}

constexpr double kNear = 0.05;  // of the diagonal: closer surfaces block the view

/// Returns whether rays that leave a point in all directions see the inside of a room: most rays hit a
/// surface, from its front, and not close by. In solid or hollow bodies rays hit backs. Around and between
/// the parts of objects they escape or end soon.
bool isInRoom(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits, double diagonal) {
    size_t met = 0, fronts = 0;
    double sum = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].isMiss()) continue;
        ++met;
        sum += hits[i].t;
        fronts += dot(triangleNormal(scene.placedTriangle(hits[i].primitive)), Vec3d(rays[i].direction)) < 0;
    }
    return 10 * met >= 7 * hits.size() && 10 * fronts >= 8 * met && sum > 0.1 * diagonal * double(met);
}

/// Returns the directions to the 26 neighbours of a cell in a grid of cubes. The first is straight down, the
/// second straight up.
std::vector<Vec3> neighbourDirections() {
    std::vector<Vec3> directions = {{0, -1, 0}, {0, 1, 0}};
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || z != 0) directions.push_back(Vec3(normalize(Vec3d(x, y, z))));
    return directions;
}

/// Returns positions of eyes: the centres of those cells of a grid in the box that are in rooms, each moved
/// to the height of a person's eyes, two fifths of the way from the floor to the ceiling. Empty if the scene
/// is not an interior.
std::vector<Vec3> eyesInRooms(const Scene& scene, const Aabb& box, const ClosestHits& closestHits) {
    constexpr int kCells = 8;
    const std::vector<Vec3> directions = neighbourDirections();
    const Vec3d low(box.min), extent = Vec3d(box.max) - low;
    std::vector<Ray> rays;
    for (int i = 0; i < kCells * kCells * kCells; ++i) {
        const Vec3d at{(i % kCells + 0.5) / kCells, (i / kCells % kCells + 0.5) / kCells,
                       (i / kCells / kCells + 0.5) / kCells};
        for (const Vec3& direction : directions)
            rays.push_back(
                {Vec3(low + Vec3d{at.x * extent.x, at.y * extent.y, at.z * extent.z}), 0, direction});
    }
    const std::vector<Hit> hits = closestHits(rays);
    std::vector<Vec3> eyes;
    for (size_t i = 0; i < rays.size(); i += directions.size()) {
        const std::span<const Ray> r(&rays[i], directions.size());
        const std::span<const Hit> h(&hits[i], directions.size());
        if (!isInRoom(scene, r, h, length(extent))) continue;
        Vec3 eye = r[0].origin;
        const double down = h[0].isMiss() ? eye.y - box.min.y : h[0].t,
                     up = h[1].isMiss() ? box.max.y - eye.y : h[1].t;
        eye.y = float(eye.y - down + 0.4 * (down + up));
        eyes.push_back(eye);
    }
    if (eyes.size() * 7 < kCells * kCells * kCells)
        eyes.clear();  // in an interior, at least a seventh of the cells are in rooms
    return eyes;
}

/// Rates a view by the primary rays of a coarse picture. A good view is deep, shows the fronts of surfaces,
/// is not blocked by close surfaces, and has many edges: neighbouring rays that hit surfaces of different
/// slope, or one far behind the other.
double viewScore(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits, uint32_t width,
                 double diagonal) {
    double depth = 0, blocked = 0, backs = 0, edges = 0;
    std::vector<Vec3d> normals(hits.size());
    for (size_t i = 0; i < hits.size(); ++i) {
        const double t = hits[i].isMiss() ? 0 : hits[i].t / diagonal;  // a view out of the scene has no depth
        depth += t;
        blocked += t < kNear;
        if (hits[i].isMiss()) continue;
        normals[i] = triangleNormal(scene.placedTriangle(hits[i].primitive));
        backs += dot(normals[i], Vec3d(rays[i].direction)) >= 0;
    }
    const auto differ = [&](size_t a, size_t b) {
        const double near = std::min(hits[a].t, hits[b].t), far = std::max(hits[a].t, hits[b].t);
        return dot(normals[a], normals[b]) < 0.9 || far > 1.5 * near;
    };
    for (size_t i = 0; i < hits.size(); ++i) {
        edges += i % width + 1 < width && differ(i, i + 1);
        edges += i + width < hits.size() && differ(i, i + width);
    }
    const double n = double(hits.size());
    return depth / n * (1 - blocked / n) * (1 - backs / n) * (0.3 + edges / (2 * n));
}

/// Returns the best of the views from each eye in sixteen directions, slightly downwards.
Camera frameRoom(const Scene& scene, std::span<const Vec3> eyes, double aspect, double diagonal,
                 const ClosestHits& closestHits) {
    const uint32_t height = 9, width = uint32_t(std::clamp(height * aspect, 1.0, 64.0));
    const size_t n = size_t(width) * height;
    std::vector<Camera> cameras;
    std::vector<Ray> rays;
    for (const Vec3& eye : eyes)
        for (int x = -2; x <= 2; ++x)
            for (int z = -2; z <= 2; ++z) {
                if (std::max(std::abs(x), std::abs(z)) < 2) continue;
                const Vec3d direction = normalize(normalize(Vec3d(x, 0, z)) + Vec3d(0, -0.08, 0));
                const Camera camera{eye, Vec3(Vec3d(eye) + direction * (0.25 * diagonal)), 60, {0, 1, 0}};
                cameras.push_back(camera);
                const PrimaryRays make(camera, width, height);
                for (uint32_t i = 0; i < n; ++i) rays.push_back(make.ray(i % width, i / width));
            }
    const std::vector<Hit> hits = closestHits(rays);
    size_t best = 0;
    double bestScore = -1;
    for (size_t i = 0; i < cameras.size(); ++i) {
        const double score = viewScore(scene, std::span(rays).subspan(i * n, n),
                                       std::span(hits).subspan(i * n, n), width, diagonal);
        if (score > bestScore) best = i, bestScore = score;
    }
    return cameras[best];
}

}  // namespace

Camera findCamera(const Scene& scene, double aspect, const ClosestHits& closestHits) {
    const Aabb box = triangleBounds(scene);
    const std::vector<Vec3> eyes = eyesInRooms(scene, box, closestHits);
    if (eyes.empty()) return frameObject(scene, box, aspect, {0.5, 0.35, 0.8});
    return frameRoom(scene, eyes, aspect, length(Vec3d(box.max) - Vec3d(box.min)), closestHits);
}

}  // namespace bvhio
