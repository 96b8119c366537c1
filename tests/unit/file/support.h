// Small files and comparisons that the tests of file/ share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "build/median.h"
#include "core/random.h"
#include "file/bvhx_file.h"

namespace bvhio {

inline std::span<const std::byte> asBytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

inline std::string written(const BvhxFile& file, const WriteOptions& options = {}) {
    std::ostringstream out;
    writeBvhx(out, file, options);
    return out.str();
}

/// Random triangles in two named geometries, one without triangles between them.
inline Scene sampleScene(uint32_t triangles) {
    Random random(7);
    std::vector<Vec3> vertices(triangles + 2);
    for (Vec3& v : vertices) v = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    std::vector<TriangleIndices> indices(triangles);
    for (uint32_t i = 0; i < triangles; ++i) indices[i] = {i, i + 1, i + 2};
    Scene scene;
    scene.vertices = std::move(vertices);
    scene.triangles = std::move(indices);
    scene.geometries = {{"floor", 0, triangles / 2},
                        {"", triangles / 2, 0},
                        {"w\xC3\xA4nde", triangles / 2, triangles - triangles / 2}};
    return scene;
}

inline BvhxFile sampleFile(uint32_t triangles = 21) {
    Scene scene = sampleScene(triangles);
    Bvh bvh = buildMedian(scene, {});
    return {scene,
            AabbForm(std::move(bvh)),
            {1.5f, 1.0f},
            {{"bvh-build", "0.1.0", "{\"builder\":\"median\"}"}},
            {}};
}

template <class T>
void expectSameArray(std::span<const T> a, std::span<const T> b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    const auto bytesA = std::as_bytes(a), bytesB = std::as_bytes(b);
    EXPECT_TRUE(std::equal(bytesA.begin(), bytesA.end(), bytesB.begin())) << what;
}

inline void expectSameContent(const BvhxFile& a, const BvhxFile& b) {
    expectSameArray<Vec3>(a.scene.vertices, b.scene.vertices, "vertices");
    expectSameArray<TriangleIndices>(a.scene.triangles, b.scene.triangles, "triangles");
    expectSameArray<uint32_t>(a.scene.sourcePrimitives, b.scene.sourcePrimitives, "source primitives");
    EXPECT_EQ(a.scene.geometries, b.scene.geometries);
    EXPECT_EQ(formNameOf(a.bvh), formNameOf(b.bvh));
    EXPECT_EQ(a.scene.meshes, b.scene.meshes);
    EXPECT_EQ(a.scene.instances, b.scene.instances);
    const auto treesOf = [](const BvhxFile& file) {
        if (!isInstanced(file.bvh)) return std::vector<Bvh>{decode(file.bvh)};
        InstancedBvh trees = std::get<TwoLevelForm>(file.bvh).decodeInstances(file.scene);
        trees.meshes.push_back(std::move(trees.top));
        return std::move(trees.meshes);
    };
    const std::vector<Bvh> treesA = treesOf(a), treesB = treesOf(b);
    ASSERT_EQ(treesA.size(), treesB.size());
    for (size_t i = 0; i < treesA.size(); ++i) {
        expectSameArray<Node>(treesA[i].nodes, treesB[i].nodes, "nodes");
        expectSameArray<uint32_t>(treesA[i].primitives, treesB[i].primitives, "primitives");
    }
    expectSameArray<uint32_t>(a.visits, b.visits, "visits");
    EXPECT_EQ(a.costs, b.costs);
    EXPECT_EQ(a.provenance, b.provenance);
    ASSERT_EQ(a.unknownChunks.size(), b.unknownChunks.size());
    for (size_t i = 0; i < a.unknownChunks.size(); ++i) {
        EXPECT_EQ(a.unknownChunks[i].type, b.unknownChunks[i].type);
        EXPECT_EQ(a.unknownChunks[i].flags, b.unknownChunks[i].flags);
        EXPECT_EQ(a.unknownChunks[i].payload, b.unknownChunks[i].payload);
    }
}

}  // namespace bvhio
