#include "rays/find_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/trace/brute_hits.h"

namespace bvhio {
namespace {

/// Returns a box of 12 triangles that face outwards, or inwards.
void addBox(std::vector<Vec3>& vertices, std::vector<TriangleIndices>& triangles, const Aabb& box,
            bool inwards) {
    const auto first = uint32_t(vertices.size());
    for (int i = 0; i < 8; ++i)
        vertices.push_back(
            {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    const uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads)
        for (int half = 0; half < 2; ++half) {
            TriangleIndices t{first + q[0], first + q[half + 1], first + q[half + 2]};
            if (inwards) std::swap(t.v1, t.v2);
            triangles.push_back(t);
        }
}

/// Returns a hall that is long in x, with two blocks at its +x end.
Scene makeHall(bool inwards) {
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;
    addBox(vertices, triangles, {{0, 0, 0}, {20, 3, 6}}, inwards);
    addBox(vertices, triangles, {{16, 0, 1}, {17, 1, 2}}, false);
    addBox(vertices, triangles, {{17, 0, 4}, {18, 1, 5}}, false);
    return makeScene(std::move(vertices), std::move(triangles));
}

/// Returns the largest |x| and |y| of the scene's vertices in the picture, where 1 is the border. Infinity if
/// a vertex is behind the eye.
std::pair<double, double> reachOnPicture(const Scene& scene, const Camera& camera, double aspect) {
    const CameraFrame frame = cameraFrame(camera);
    double x = 0, y = 0;
    for (const Vec3& vertex : scene.vertices) {
        const Vec3d p = Vec3d(vertex) - Vec3d(camera.eye);
        const double depth = dot(p, frame.forward) * halfTangent(camera.fov);
        if (depth <= 0) return {1e300, 1e300};
        x = std::max(x, std::fabs(dot(p, frame.right)) / (depth * aspect));
        y = std::max(y, std::fabs(dot(p, frame.up)) / depth);
    }
    return {x, y};
}

TEST(FindCamera, objectsFillThePicture) {
    for (const float scale : {1e-6f, 1.0f, 1e6f})
        for (const double aspect : {0.4, 1.0, 2.5}) {
            const Scene ball = makeBall(scale, Vec3{7, 1, -3} * scale);
            const auto [x, y] = reachOnPicture(ball, findCamera(ball, aspect, bruteForce(ball)), aspect);
            EXPECT_LT(std::max(x, y), 0.97) << scale << ' ' << aspect;
            EXPECT_GT(std::max(x, y), 0.90) << scale << ' ' << aspect;
        }
}

TEST(FindCamera, looksAlongAHallFromInside) {
    const Scene hall = makeHall(true);
    const Camera camera = findCamera(hall, 4.0 / 3, bruteForce(hall));
    EXPECT_TRUE(triangleBounds(hall).contains({camera.eye, camera.eye}));
    const Vec3d forward = cameraFrame(camera).forward;
    EXPECT_GT(std::fabs(forward.x), 0.8);
    EXPECT_GT(forward.x > 0 ? 20 - camera.eye.x : camera.eye.x, 12);  // most of the hall is ahead
}

// The same walls facing outwards are a solid block: from inside one would see only the backs of its sides.
TEST(FindCamera, staysOutsideASolid) {
    const Scene block = makeHall(false);
    const Camera camera = findCamera(block, 4.0 / 3, bruteForce(block));
    EXPECT_FALSE(triangleBounds(block).contains({camera.eye, camera.eye}));
    const auto [x, y] = reachOnPicture(block, camera, 4.0 / 3);
    EXPECT_LT(std::max(x, y), 0.97);
}

TEST(FindCamera, isValidForDegenerateScenes) {
    const float top = std::numeric_limits<float>::max();
    const std::vector<Vec3> triples[] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                // a point
        {{1e6f, 1, 1}, {1e6f, 1, 1}, {1e6f, 1, 1}},       // one far off
        {{0, 0, 0}, {0, 5, 0}, {0, 9, 0}},                // a line
        {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},                // flat
        {{-top, -top, -top}, {top, 0, 0}, {0, top, top}}  // as large as can be
    };
    for (const auto& vertices : triples) {
        const Scene scene = makeScene(vertices, {{0, 1, 2}});
        const Camera camera = findCamera(scene, 1.5, bruteForce(scene));
        EXPECT_EQ(parseCamera(formatCamera(camera)), camera);  // parseCamera rejects invalid cameras
    }
}

}  // namespace
}  // namespace bvhio
