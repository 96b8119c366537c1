// A table of imported scenes whose meshes are in many places. Tests of instances loop over it, and compare
// with the flattened scene.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/test_scenes.h"
#include "importers/import.h"

namespace bvhio::test {

inline Mesh meshOf(const std::string& name, const Scene& scene) {
    return {name,
            {scene.vertices.begin(), scene.vertices.end()},
            {scene.triangles.begin(), scene.triangles.end()}};
}

inline Transform randomTransform(Random& random, double size, double stretch, double span) {
    // A rotation from a random quaternion, with each axis scaled by itself.
    double q[4], norm = 0;
    for (double& x : q) {
        x = double(random.uniform(-1, 1));
        norm += x * x;
    }
    for (double& x : q) x /= std::sqrt(norm);
    const auto [x, y, z, w] = q;
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    Transform result;
    double scale[3];
    for (double& s : scale) s = size * (1 + stretch * double(random.uniform()));
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 3; ++column)
            result[4 * row + column] = r[3 * row + column] * scale[column];
        result[4 * row + 3] = span * double(random.uniform(-1, 1));
    }
    return result;
}

struct InstancedScene {
    std::string name;
    ImportedScene imported;
};

inline std::vector<InstancedScene> instancedScenes() {
    const Mesh sphere = meshOf("sphere", sphereScene(8, 6));
    const Mesh grid = meshOf("grid", gridScene(3, [](float x, float y) { return x * y / 4; }));
    const Mesh flat = meshOf("flat", gridScene(2, [](float, float) { return 0.0f; }));
    const Mesh soup = meshOf("soup", sceneOf(randomTriangles(12, 1, 0.5f)));
    Random random(7);
    std::vector<InstancedScene> scenes;

    ImportedScene rotated{{sphere, grid, soup}, {}};
    for (uint32_t i = 0; i < 12; ++i) rotated.instances.push_back({i % 3, randomTransform(random, 1, 0, 4)});
    scenes.push_back({"rotated", rotated});

    ImportedScene stretched{{sphere, grid, flat}, {}};
    for (uint32_t i = 0; i < 12; ++i) {
        Transform transform = randomTransform(random, 0.5, 3, 4);
        if (i % 2)
            for (size_t k : {0, 4, 8}) transform[k] = -transform[k];  // mirrored
        stretched.instances.push_back({i % 3, transform});
    }
    scenes.push_back({"stretched and mirrored", stretched});

    // Shears; the last one is too strong for tracing rays through it.
    ImportedScene sheared{{grid, sphere}, {}};
    for (const double shear : {0.5, -2.0, 10.0, 1000.0})
        for (const uint32_t mesh : {0u, 1u})
            sheared.instances.push_back(
                {mesh, Transform{1, shear, 0, shear, 0, 1, 0.3, double(mesh), 0, 0, 1, shear / 2}});
    scenes.push_back({"sheared", sheared});

    // Parts close together, parts in the same place twice (ties), flattened parts, and a part without
    // triangles.
    ImportedScene parts{{sphere, grid, {"points", {{0, 0, 0}}, {}}}, {}};
    for (const Transform& transform :
         {kIdentityTransform, randomTransform(random, 1, 1, 2), kIdentityTransform,
          Transform{1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, Transform{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}}) {
        parts.instances.push_back({2, transform});
        parts.instances.push_back({0, transform});
        parts.instances.push_back({1, transform, "", true});
    }
    scenes.push_back({"parts", parts});

    ImportedScene sizes{{sphere, soup}, {}};
    for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        for (const uint32_t mesh : {0u, 1u})
            sizes.instances.push_back({mesh, randomTransform(random, size, 0.5, 2 * size)});
    scenes.push_back({"of all sizes", sizes});

    // Boxes that only touch, like tiles, on planes in which test rays lie.
    ImportedScene tiles{{flat}, {}};
    for (int i = 0; i < 9; ++i)
        tiles.instances.push_back({0, Transform{1, 0, 0, 2.0 * (i % 3), 0, 1, 0, 2.0 * (i / 3), 0, 0, 1, 0}});
    scenes.push_back({"tiles", tiles});

    scenes.push_back({"one", {{grid}, {{0, randomTransform(random, 1, 0, 1)}}}});
    return scenes;
}

}  // namespace bvhio::test
