// A table of awkward scenes, which break careless code. Property tests loop over it.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/random.h"
#include "scene/scene.h"

namespace bvhio::test {

/// Returns a scene of one geometry whose triangles share no vertices. Turns -0 into +0, like importers.
inline Scene sceneOf(const std::vector<Triangle>& triangles) {
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> indices;
    for (const Triangle& t : triangles) {
        const auto first = uint32_t(vertices.size());
        for (const Vec3& v : {t.v0, t.v1, t.v2}) vertices.push_back({v.x + 0.0f, v.y + 0.0f, v.z + 0.0f});
        indices.push_back({first, first + 1, first + 2});
    }
    const auto count = uint32_t(indices.size());
    return {std::move(vertices), std::move(indices), {{"test", 0, count}}, {}};
}

/// Returns a grid of 2 * side * side triangles over [0, side]^2 with shared vertices. height(x, y) is the
/// third coordinate.
template <class Height>
Scene gridScene(uint32_t side, const Height& height) {
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> indices;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            vertices.push_back({float(x), float(y), height(float(x), float(y))});
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t corner = y * (side + 1) + x, above = corner + side + 1;
            indices.push_back({corner, corner + 1, above});
            indices.push_back({corner + 1, above + 1, above});
        }
    const auto count = uint32_t(indices.size());
    return {std::move(vertices), std::move(indices), {{"grid", 0, count}}, {}};
}

/// Returns a closed sphere of radius 1 around the origin whose triangles share vertices: 2 * segments *
/// (rings - 1) triangles, with the fans at the poles. It is watertight: a ray from inside hits it exactly
/// once.
inline Scene sphereScene(uint32_t segments, uint32_t rings) {
    constexpr double kPi = 3.14159265358979323846;
    std::vector<Vec3> vertices{{0, 0, 1}};
    for (uint32_t ring = 1; ring < rings; ++ring)
        for (uint32_t s = 0; s < segments; ++s) {
            const double polar = kPi * ring / rings, around = 2 * kPi * s / segments;
            vertices.push_back({float(std::sin(polar) * std::cos(around)) + 0.0f,
                                float(std::sin(polar) * std::sin(around)) + 0.0f,
                                float(std::cos(polar)) + 0.0f});
        }
    vertices.push_back({0, 0, -1});
    const auto south = uint32_t(vertices.size()) - 1;
    const auto at = [&](uint32_t ring, uint32_t s) { return 1 + (ring - 1) * segments + s % segments; };
    std::vector<TriangleIndices> indices;
    for (uint32_t s = 0; s < segments; ++s) {
        indices.push_back({0, at(1, s), at(1, s + 1)});
        for (uint32_t ring = 1; ring + 1 < rings; ++ring) {
            indices.push_back({at(ring, s), at(ring + 1, s), at(ring + 1, s + 1)});
            indices.push_back({at(ring, s), at(ring + 1, s + 1), at(ring, s + 1)});
        }
        indices.push_back({at(rings - 1, s), south, at(rings - 1, s + 1)});
    }
    const auto count = uint32_t(indices.size());
    return {std::move(vertices), std::move(indices), {{"sphere", 0, count}}, {}};
}

/// Returns `count` random triangles with vertices within `size` of a centre in [-span, span]^3.
inline std::vector<Triangle> randomTriangles(uint32_t count, float span, float size, uint64_t seed = 1) {
    Random random(seed);
    const auto point = [&](float s) {
        const float x = random.uniform(-s, s), y = random.uniform(-s, s);
        return Vec3{x, y, random.uniform(-s, s)};
    };
    std::vector<Triangle> triangles(count);
    for (Triangle& t : triangles) {
        const Vec3 center = point(span);
        t.v0 = center + point(size);
        t.v1 = center + point(size);
        t.v2 = center + point(size);
    }
    return triangles;
}

/// Returns `count` triangles of the same size around one centroid, so that no plane separates them.
inline Scene coincidentScene(uint32_t count) {
    std::vector<Vec3> vertices{{-1, -1, -1}, {1, -1, 0}, {0, 1, 1}};
    std::vector<TriangleIndices> indices(count, TriangleIndices{0, 1, 2});
    return {std::move(vertices), std::move(indices), {{"coincident", 0, count}}, {}};
}

struct TestScene {
    const char* name;
    Scene (*make)();
};

/// The table. Every row is a valid Scene, small enough for brute force over many rays.
inline std::span<const TestScene> testScenes() {
    static constexpr TestScene kTable[] = {
        {"oneTriangle",
         [] {
             return sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
         }},
        {"twoTriangles",
         [] {
             return sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{5, 5, 5}, {6, 5, 5}, {5, 6, 7}}});
         }},
        {"onePoint",
         [] {
             return sceneOf({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}});
         }},
        {"samePoint",
         [] {
             return sceneOf(std::vector<Triangle>(50, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
         }},
        {"duplicates", [] { return coincidentScene(100); }},
        {"twoStacksOfDuplicates",
         [] {
             std::vector<Triangle> triangles(40, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
             triangles.insert(triangles.end(), 25, {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
             return sceneOf(triangles);
         }},
        {"concentric",  // one centroid, boxes of every size
         [] {
             std::vector<Triangle> triangles;
             for (int i = 1; i <= 60; ++i) {
                 const auto r = float(i);
                 triangles.push_back({{-r, -r, -r}, {r, -r, r}, {r, r, r}});
             }
             return sceneOf(triangles);
         }},
        {"linePoints",  // no areas: for careless code every SAH ratio is 0 / 0
         [] {
             std::vector<Triangle> triangles;
             for (int i = 0; i < 200; ++i) {
                 const Vec3 p{float(i), 0, 0};
                 triangles.push_back({p, p, p});
             }
             return sceneOf(triangles);
         }},
        {"diagonalSegments",
         [] {
             std::vector<Triangle> triangles;
             for (int i = 0; i < 200; ++i) {
                 const auto f = float(i);
                 triangles.push_back({{f, f, f}, {f + 1, f + 1, f + 1}, {f + 2, f + 2, f + 2}});
             }
             return sceneOf(triangles);
         }},
        {"flatGrid", [] { return gridScene(24, [](float, float) { return 0.0f; }); }},
        {"tiltedGrid", [] { return gridScene(24, [](float x, float y) { return 0.37f * x + 0.11f * y; }); }},
        {"terrain",
         [] {
             return gridScene(32, [](float x, float y) { return float((int(x) * 7 + int(y) * 13) % 5); });
         }},
        {"tiny", [] { return sceneOf(randomTriangles(300, 1e-30f, 1e-31f)); }},
        {"denormal", [] { return sceneOf(randomTriangles(100, 1e-39f, 1e-40f)); }},
        {"huge", [] { return sceneOf(randomTriangles(300, 1e38f, 1e37f)); }},
        {"extentsOverflow",  // max - min is beyond float
         [] {
             std::vector<Triangle> triangles = randomTriangles(100, 1, 0.1f);
             for (Triangle& t : triangles)
                 for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * 3e38f;
             return sceneOf(triangles);
         }},
        {"farFromOrigin",  // coordinates a few floats apart
         [] {
             std::vector<Triangle> triangles = randomTriangles(300, 1, 0.2f);
             for (Triangle& t : triangles)
                 for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v + Vec3{1e6f, -1e6f, 1e6f};
             return sceneOf(triangles);
         }},
        {"mixedScales",
         [] {
             std::vector<Triangle> triangles;
             for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
                 for (const Triangle& t : randomTriangles(60, scale, scale * 0.1f, uint64_t(scale) + 1))
                     triangles.push_back(t);
             return sceneOf(triangles);
         }},
        {"halvingDistances",  // each binned split takes off a few triangles, so trees are very deep
         [] {
             std::vector<Triangle> triangles;
             float x = 1e38f;
             for (int i = 0; i < 240; ++i, x *= 0.5f) triangles.push_back({{x, 0, 0}, {x, x, 0}, {x, 0, x}});
             return sceneOf(triangles);
         }},
        {"longThin",
         [] {
             std::vector<Triangle> triangles;
             Random random(5);
             for (int i = 0; i < 200; ++i) {
                 const float y = random.uniform(-1, 1), z = random.uniform(-1, 1);
                 triangles.push_back({{-100, y, z}, {100, z, y}, {100, z + 1e-3f, y}});
             }
             return sceneOf(triangles);
         }},
        {"oneLargeManySmall",
         [] {
             std::vector<Triangle> triangles = randomTriangles(300, 1, 0.02f);
             triangles.push_back({{-1000, -1000, -5}, {1000, -1000, -5}, {0, 1000, -5}});
             return sceneOf(triangles);
         }},
        {"soup", [] { return sceneOf(randomTriangles(1000, 1, 0.3f)); }},
        {"sphere", [] { return sphereScene(24, 12); }},
    };
    return kTable;
}

}  // namespace bvhio::test
