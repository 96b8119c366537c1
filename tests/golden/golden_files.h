// The contents of the golden files: a file for each chunk, codec and geometry encoding. Coordinates are small
// dyadic numbers, so that every compiler and processor computes the same values.
#pragma once

#include <string>
#include <vector>

#include "build/instanced.h"
#include "build/median.h"
#include "common/shuffled_tree.h"
#include "container/container.h"
#include "file/bvhx_file.h"
#include "relayout/clusters.h"

namespace bvhio {

struct GoldenFile {
    std::string name;
    BvhxFile content;
    WriteOptions options;
};

/// Returns the two triangles whose bytes the pages of format-spec explain.
inline BvhxFile twoTriangles() {
    Scene scene;
    scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    scene.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 1, 3}};
    scene.geometries = {{"a", 0, 2}};
    AlignedVector<Node> nodes{
        {{{0, 0, 0}, {1, 1, 2}}, 2, 0}, {}, {{{0, 0, 0}, {1, 1, 0}}, 0, 1}, {{{0, 0, 0}, {1, 0, 2}}, 1, 1}};
    return {scene, AabbForm({std::move(nodes), std::vector<uint32_t>{0, 1}}), {1.5f, 1.0f}, {}, {}};
}

/// Returns a bumpy grid in three geometries, with source numbers of primitives, provenance, and chunks of
/// unknown types.
inline BvhxFile grid() {
    constexpr uint32_t side = 6;
    std::vector<Vec3> vertices;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            vertices.push_back({float(x) * 0.5f, float(y) * 0.25f, float((x * 7 + y * 3) % 5) * 0.125f});
    std::vector<TriangleIndices> triangles;
    std::vector<uint32_t> source;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t v = y * (side + 1) + x;
            triangles.push_back({v, v + 1, v + side + 1});
            triangles.push_back({v + 1, v + side + 2, v + side + 1});
            source.push_back(4 * (y * side + x));
            source.push_back(4 * (y * side + x) + 1);
        }
    Scene scene;
    const auto count = uint32_t(triangles.size());
    scene.vertices = std::move(vertices);
    scene.triangles = std::move(triangles);
    scene.sourcePrimitives = std::move(source);
    scene.geometries = {{"floor", 0, 30}, {"", 30, 0}, {"W\xC3\xA4nde", 30, count - 30}};
    Bvh bvh = buildMedian(scene, {});
    const auto payload = [](const std::string& text) {
        const auto bytes = std::as_bytes(std::span(text));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    return {
        scene,
        AabbForm(std::move(bvh)),
        {1.25f, 1.0f},
        {{"bvh-build", "0.1.0", R"({"builder":"median"})"}, {"bvh-relayout", "0.1.0", R"({"layout":"dfs"})"}},
        {{chunkType("xTRI"), kSurvivesReorder | kSurvivesTopologyChange, payload("of each triangle")},
         {chunkType("xNOD"), kSurvivesTopologyChange, payload("")},
         {chunkType("xTRE"), kSurvivesReorder, payload("of the tree")}}};
}

/// Returns a file with visits that five rays could have made: fewer on each lower level.
inline BvhxFile visited(BvhxFile file) {
    const Bvh& bvh = std::get<AabbForm>(file.bvh).bvh();
    std::vector<uint32_t> visits(bvh.nodes.size() / 2, 5);
    for (size_t i = 0; i < bvh.nodes.size(); ++i)
        if (i != 1 && !bvh.nodes[i].isLeaf())
            visits[bvh.nodes[i].left() / 2] =
                visits[i / 2] - (i == 0 ? 2 : std::min(visits[i / 2], uint32_t(i % 2)));
    file.visits = std::move(visits);
    return file;
}

/// Returns a file with one triangle, in the root.
inline BvhxFile oneLeaf() {
    Scene scene;
    scene.vertices = std::vector<Vec3>{{1, 1, 1}, {1, 1, 1}, {3, 1, 1}};
    scene.triangles = std::vector<TriangleIndices>{{0, 1, 2}};
    scene.geometries = {{"", 0, 0}, {"line", 0, 1}};
    AlignedVector<Node> nodes{{{{1, 1, 1}, {3, 1, 1}}, 0, 1}, {}};
    return {scene, AabbForm({std::move(nodes), std::vector<uint32_t>{0}}), {}, {}, {}};
}

/// Returns a file with two triangles, the second of which was split: two leaves have a part of it each.
inline BvhxFile splitTriangle() {
    Scene scene;
    scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {4, 0, 0}};
    scene.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 3, 2}};
    scene.geometries = {{"", 0, 2}};
    AlignedVector<Node> nodes{{{{0, 0, 0}, {4, 1, 0}}, 2, 0},
                              {},
                              {{{0, 0, 0}, {2, 1, 0}}, 1, 2},
                              {{{2, 0, 0}, {4, 0.5f, 0}}, 0, 1}};
    return {scene, AabbForm({std::move(nodes), std::vector<uint32_t>{1, 0, 1}}), {}, {}, {}};
}

/// Returns the grid with its pairs and its leaves' ranges in an order without a name.
inline BvhxFile shuffledGrid() {
    BvhxFile file = grid();
    file.bvh = AabbForm(test::shuffledTree(decode(file.bvh), 1));
    return file;
}

/// Returns a file with its tree in clusters.
inline BvhxFile inClusters(BvhxFile file, uint32_t pointerBits, uint32_t lineSize) {
    const Bvh bvh = decode(file.bvh);
    file.bvh =
        AabbForm(applyLayout(bvh, layoutClusters(bvh, {.lineSize = lineSize, .pointerBits = pointerBits})));
    return file;
}

/// Returns a file with its tree in another form.
inline BvhxFile inForm(BvhxFile file, std::string_view form, const EncodeOptions& options = {}) {
    file.bvh = choose(forms(), "form", form).function(file.scene, decode(file.bvh), options);
    return file;
}

/// Returns a file with its tree in two levels.
inline BvhxFile inTwoLevels(BvhxFile file, TlasForm tlas, BlasForm blas, uint32_t blasSize,
                            uint32_t bits = 8) {
    return inForm(
        std::move(file), "two-level",
        TwoLevelForm::Options{
            .tlasForm = tlas, .blasForm = blas, .blasSize = blasSize, .bits = bits, .blasLeafSize = 4});
}

/// Returns the two triangles as a mesh in two places. The second instance is stretched and mirrored.
inline BvhxFile twoPlaces() {
    BvhxFile file = twoTriangles();
    Scene& scene = file.scene;
    scene.meshes = {{.geometryCount = 1}};
    scene.instances = {{kIdentityAffine, 0, 0, 0}, {{2, 0, 0, 3, 0, -1, 0, 0, 0, 0, 1, 0.5f}, 0, 0, 1}};
    numberInstances(scene);
    const InstancedBvh trees =
        buildInstanced(scene, choose(builders(), "builder", "median"), {.costs = {}, .maxLeafSize = 1});
    file.bvh = TwoLevelForm::encodeInstances(scene, trees, TwoLevelForm::exactLevels());
    return file;
}

/// Returns the grid as two meshes in five places, below a quantized top level. Numbers of geometries have
/// gaps.
inline BvhxFile gridPlaces(BlasForm blas) {
    BvhxFile file = grid();
    Scene& scene = file.scene;
    scene.meshes = {{.geometryCount = 2}, {.geometryCount = 1}};
    scene.instances = {{kIdentityAffine, 0, 0, 0},
                       {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 2}, 1, 0, 2},
                       {{0, -1, 0, 4, 1, 0, 0, 0, 0, 0, 0.5f, 0}, 0, 0, 7},
                       {{1, 0.25f, 0, 0, 0, 1, 0, 5, 0, 0, 2, 1}, 1, 0, 9},
                       {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0, 0, 10}};
    numberInstances(scene);
    const InstancedBvh trees = buildInstanced(scene, choose(builders(), "builder", "median"), {});
    file.bvh = TwoLevelForm::encodeInstances(
        scene, trees, {.tlasForm = TlasForm::quantized, .blasForm = blas, .blasLeafSize = 4});
    return file;
}

inline std::vector<GoldenFile> goldenFiles() {
    return {
        {"two_triangles", twoTriangles(), {}},
        {"grid_none", grid(), {}},
        {"grid_zstd", grid(), {.codec = "zstd"}},
        {"grid_draco", grid(), {.geometry = GeometryEncoding::draco, .dracoPositionBits = 8}},
        {"grid_draco_zstd",
         grid(),
         {.codec = "zstd", .geometry = GeometryEncoding::draco, .dracoPositionBits = 8}},
        {"two_triangles_quantized", inForm(twoTriangles(), "quantized"), {}},
        {"grid_quantized_zstd", inForm(grid(), "quantized"), {.codec = "zstd"}},
        {"grid_quantized_6", inForm(grid(), "quantized", QuantizedForm::Options{.bits = 6}), {}},
        {"one_leaf_quantized", inForm(oneLeaf(), "quantized"), {}},
        {"two_triangles_quantized_short", inForm(twoTriangles(), "quantized-short"), {}},
        {"grid_quantized_short",
         inForm(grid(), "quantized-short", QuantizedShortForm::Options{.pointerBits = 3, .lineSize = 16}),
         {}},
        {"one_leaf_quantized_short", inForm(oneLeaf(), "quantized-short"), {}},
        {"two_triangles_clusters", inClusters(twoTriangles(), 8, 64), {}},
        {"grid_clusters", inClusters(grid(), 3, 16), {}},
        {"grid_clusters_topology",
         inClusters(grid(), 3, 16),
         {.codec = "zstd", .nodes = NodeEncoding::topology}},
        {"two_triangles_ssh", inForm(twoTriangles(), "ssh"), {}},
        {"grid_ssh_zstd", inForm(grid(), "ssh"), {.codec = "zstd"}},
        {"two_triangles_topology", twoTriangles(), {.nodes = NodeEncoding::topology}},
        {"grid_topology_zstd", grid(), {.codec = "zstd", .nodes = NodeEncoding::topology}},
        {"grid_shuffled_topology", shuffledGrid(), {.nodes = NodeEncoding::topology}},
        {"split_triangle_topology", splitTriangle(), {.nodes = NodeEncoding::topology}},
        {"two_triangles_two_level", inTwoLevels(twoTriangles(), TlasForm::aabb, BlasForm::ssh, 2), {}},
        {"two_leaves_two_level", inTwoLevels(twoTriangles(), TlasForm::aabb, BlasForm::aabb, 1), {}},
        {"grid_aabb_over_ssh", inTwoLevels(grid(), TlasForm::aabb, BlasForm::ssh, 9), {}},
        {"grid_quantized_over_mvh", inTwoLevels(grid(), TlasForm::quantized, BlasForm::mvh, 16), {}},
        {"two_triangles_over_mvh", inTwoLevels(twoTriangles(), TlasForm::quantized, BlasForm::mvh, 2), {}},
        {"grid_quantized_over_ssh", inTwoLevels(grid(), TlasForm::quantized, BlasForm::ssh, 9), {}},
        {"grid_aabb_over_mvh", inTwoLevels(grid(), TlasForm::aabb, BlasForm::mvh, 40), {}},
        {"grid_aabb_over_aabb", inTwoLevels(grid(), TlasForm::aabb, BlasForm::aabb, 9), {}},
        {"grid_over_mvh_leaf_3",
         inForm(grid(), "two-level", TwoLevelForm::Options{.blasSize = 20, .blasLeafSize = 3}),
         {}},
        {"two_triangles_over_quantized",
         inTwoLevels(twoTriangles(), TlasForm::aabb, BlasForm::quantized, 2),
         {}},
        {"grid_aabb_over_quantized", inTwoLevels(grid(), TlasForm::aabb, BlasForm::quantized, 20), {}},
        {"grid_quantized_over_quantized_6",
         inTwoLevels(grid(), TlasForm::quantized, BlasForm::quantized, 20, 6),
         {}},
        {"two_triangles_instances", twoPlaces(), {}},
        {"grid_instances_zstd", gridPlaces(BlasForm::ssh), {.codec = "zstd"}},
        {"grid_instances_quantized", gridPlaces(BlasForm::quantized), {}},
        {"grid_instances_mvh", gridPlaces(BlasForm::mvh), {}},
        {"two_triangles_visits", visited(twoTriangles()), {}},
        {"grid_visits_zstd", visited(grid()), {.codec = "zstd"}},
        {"grid_shuffled_visits_topology", visited(shuffledGrid()), {.nodes = NodeEncoding::topology}},
        {"one_leaf", oneLeaf(), {}},
        {"split_triangle", splitTriangle(), {}}};
}

}  // namespace bvhio
