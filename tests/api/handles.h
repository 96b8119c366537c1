// Handles that close themselves, and the small scenes that the tests of the API share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "api/bvhio.h"

namespace apitest {

struct Closer {
    void operator()(BvhioContainer* handle) const { bvhioClose(handle); }
    void operator()(BvhioScene* handle) const { bvhioDestroyScene(handle); }
    void operator()(BvhioTracer* handle) const { bvhioDestroyTracer(handle); }
    void operator()(void* bytes) const { bvhioFree(bytes); }
};
using Container = std::unique_ptr<BvhioContainer, Closer>;
using Scene = std::unique_ptr<BvhioScene, Closer>;
using Tracer = std::unique_ptr<BvhioTracer, Closer>;

/// Arrays that stay where a BvhioSceneArrays refers to them.
struct Arrays {
    std::vector<float> vertices;
    std::vector<uint32_t> indices;

    BvhioSceneArrays view() const {
        BvhioSceneArrays arrays{};
        arrays.vertices = vertices.data();
        arrays.vertexCount = vertices.size() / 3;
        arrays.indices = indices.data();
        arrays.triangleCount = indices.size() / 3;
        return arrays;
    }
};

/// A bumpy grid of 2 * side * side triangles over [0, side]^2.
inline Arrays grid(uint32_t side) {
    Arrays arrays;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            for (const float value : {float(x), float(y), std::sin(float(x * 3 + y * 5))})
                arrays.vertices.push_back(value);
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t corner = y * (side + 1) + x, above = corner + side + 1;
            for (const uint32_t index : {corner, corner + 1, above, corner + 1, above + 1, above})
                arrays.indices.push_back(index);
        }
    return arrays;
}

inline Scene makeScene(const BvhioSceneArrays& arrays) {
    BvhioScene* scene = nullptr;
    EXPECT_EQ(bvhioCreateScene(&arrays, &scene), BVHIO_OK) << bvhioLastError();
    return Scene(scene);
}

inline Container build(const BvhioScene* scene, const std::vector<const char*>& options = {}) {
    std::vector<const char*> ended = options;
    ended.push_back(nullptr);
    BvhioContainer* container = nullptr;
    EXPECT_EQ(bvhioBuild(scene, ended.data(), nullptr, &container), BVHIO_OK) << bvhioLastError();
    return Container(container);
}

inline Container gridContainer(uint32_t side = 8) {
    const Arrays arrays = grid(side);
    const Scene scene = makeScene(arrays.view());
    return build(scene.get());
}

/// Two instances of a grid, the second 100 to the right, and one of a single triangle at z = 50.
inline Scene instancedScene() {
    const Arrays arrays = [] {
        Arrays both = grid(4);
        const auto first = uint32_t(both.vertices.size() / 3);
        for (const float value : {0, 0, 50, 1, 0, 50, 0, 1, 50}) both.vertices.push_back(value);
        for (uint32_t i = 0; i < 3; ++i) both.indices.push_back(first + i);
        return both;
    }();
    const BvhioPart parts[] = {{"grid", 32}, {"triangle", 1}};
    const uint32_t meshes[] = {1, 1};
    const BvhioPlacement placements[] = {{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                                         {0, {1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0}},
                                         {1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}};
    BvhioSceneArrays view = arrays.view();
    view.parts = parts;
    view.partCount = 2;
    view.meshes = meshes;
    view.meshCount = 2;
    view.placements = placements;
    view.placementCount = 3;
    return makeScene(view);
}

struct Bytes {
    std::unique_ptr<void, Closer> data;
    size_t size = 0;
    const char* begin() const { return static_cast<const char*>(data.get()); }
};

inline Bytes saved(const BvhioContainer* container) {
    void* bytes = nullptr;
    size_t size = 0;
    EXPECT_EQ(bvhioSaveMemory(container, nullptr, &bytes, &size), BVHIO_OK) << bvhioLastError();
    return {std::unique_ptr<void, Closer>(bytes), size};
}

inline BvhioInfo infoOf(const BvhioContainer* container) {
    BvhioInfo info{};
    EXPECT_EQ(bvhioGetInfo(container, &info), BVHIO_OK) << bvhioLastError();
    return info;
}

inline Tracer makeTracer(const BvhioContainer* container, uint32_t flags = 0) {
    BvhioTracer* tracer = nullptr;
    EXPECT_EQ(bvhioCreateTracer(container, flags, nullptr, &tracer), BVHIO_OK) << bvhioLastError();
    return Tracer(tracer);
}

/// A ray straight down.
inline BvhioRay rayDown(float x, float y, float fromZ = 10) {
    return {{x, y, fromZ}, 0, {0, 0, -1}, INFINITY};
}

/// Whether the last failure's text has the word.
inline bool lastErrorHas(const std::string& word) {
    return std::string(bvhioLastError()).find(word) != std::string::npos;
}

}  // namespace apitest
