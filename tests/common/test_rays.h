// Awkward rays, which break careless code.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "core/ray.h"
#include "scene/scene.h"

namespace bvhio::test {

/// Returns rays at a scene's vertices, edges and triangles, from near, far, on planes and inside boxes; with
/// directions that have zeros, negative zeros and denormals, and any length; with limits before, at and after
/// hits; and rays that miss by definition.
inline std::vector<Ray> awkwardRays(const Scene& scene, uint64_t seed = 1, uint32_t rounds = 40) {
    constexpr float kInf = std::numeric_limits<float>::infinity(),
                    kNaN = std::numeric_limits<float>::quiet_NaN();
    Random random(seed);
    Aabb box = Aabb::empty();
    for (const Vec3& v : scene.vertices) box.extend(v);
    const Vec3 center = box.center(), half = box.max * 0.5f - box.min * 0.5f;
    const auto anywhere = [&](float scale) {
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
        return center + Vec3{half.x * x, half.y * y, half.z * z} * scale;
    };
    const auto triangle = [&] { return scene.triangle(random.below(uint32_t(scene.triangles.size()))); };

    std::vector<Ray> rays;
    const auto add = [&](Vec3 origin, Vec3 direction) { rays.push_back({origin, 0, direction, kInf}); };
    for (uint32_t round = 0; round < rounds; ++round) {
        const Triangle t = triangle();
        const Vec3 targets[] = {t.v0, t.v1, t.v0 * 0.5f + t.v1 * 0.5f, t.v1 * 0.25f + t.v2 * 0.75f,
                                t.v0 * 0.5f + t.v1 * 0.25f + t.v2 * 0.25f};
        for (const Vec3& target : targets) {
            for (const Vec3& origin : {anywhere(1), anywhere(3), anywhere(100), triangle().v0, center})
                for (const float length : {1.0f, 1e-3f, 64.0f}) add(origin, (target - origin) * length);
            // Along an axis, from both sides of the target, and from the target itself. The other components
            // are zeros of both signs.
            for (int axis = 0; axis < 3; ++axis)
                for (const float sign : {1.0f, -1.0f}) {
                    Vec3 direction{round % 2 ? 0.0f : -0.0f, 0.0f, round % 3 ? -0.0f : 0.0f};
                    direction[axis] = sign;
                    Vec3 before = target;
                    before[axis] -= sign * half[axis] * 3;
                    add(before, direction);
                    add(target, direction);
                    direction[(axis + 1) % 3] = 1e-42f;  // denormal
                    add(before, direction);
                    direction[(axis + 2) % 3] = random.uniform(-1, 1);
                    add(before, direction);
                    add(target, direction);
                }
        }
        // In an axis-aligned plane.
        Vec3 inPlane = anywhere(1) - anywhere(1);
        inPlane[int(round % 3)] = 0;
        add(t.v2, inPlane);
        add(anywhere(1), inPlane);
    }
    // Limits before, at and after the hit are tried by the test, which knows the hit.
    const Vec3 origin = anywhere(2), direction = center - origin;
    add(origin, direction * 1e30f);
    add(origin, direction * 1e-30f);
    add(origin, {1e-40f, -1e-41f, 1e-42f});
    rays.push_back({origin, -5, direction, kInf});
    rays.push_back({origin, -kInf, direction, kInf});
    // These miss by definition.
    add({kNaN, 0, 0}, {0, 0, 1});
    add({0, kInf, 0}, {0, 0, 1});
    add(origin, {0, kNaN, 1});
    add(origin, {0, -kInf, 1});
    add(origin, {0, -0.0f, 0});
    rays.push_back({origin, kNaN, direction, kInf});
    rays.push_back({origin, 0, direction, kNaN});
    rays.push_back({origin, 2, direction, 1});
    rays.push_back({origin, -2, direction, -1});
    return rays;
}

}  // namespace bvhio::test
