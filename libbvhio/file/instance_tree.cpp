#include "file/instance_tree.h"

#include <algorithm>

#include "compress/forest.h"
#include "scene/triangle_bounds.h"

namespace bvhio {

TreeParameters parametersOfInstances(uint32_t formCode, const TwoLevelForm& form) {
    const TwoLevels levels = form.decodeLevels();
    uint32_t depth = depthOf(levels.top);
    const auto separate = separateTrees(levels.bottom, form.primitives());
    for (const Bvh& tree : separate->trees) depth = std::max(depth, depthOf(tree));
    return {
        formCode, levels.top.nodes.size() + levels.bottom.nodes.size(), form.primitives().size(), {}, depth};
}

SharedArray<uint32_t> readEntries(ChunkSequence& chunks, const Scene& scene) {
    auto entries = chunks.expectArray<uint32_t>(kEntriesType, scene.instances.size());
    for (const uint32_t instance : entries)
        if (instance >= scene.instances.size())
            chunks.fail(FindingId::primitiveIndex, "an entry refers to instance " + std::to_string(instance) +
                                                       ", but there are only " +
                                                       std::to_string(scene.instances.size()));
    return entries;
}

void validateInstances(ChunkSequence& chunks, const TwoLevelForm& form, const TreeParameters& parameters,
                       const Scene& scene, const NodesPlace& topPlace, const NodesPlace& bottomPlace) {
    if (chunks.isTrusted()) return;
    uint32_t depth = 0;
    // Checks one tree, and moves its findings to the place of its nodes in the file.
    const auto validateOne = [&](const Bvh& bvh, size_t primitives, const PrimitiveBounds& bounds,
                                 const std::string& name, const NodesPlace& place, bool isBottom,
                                 uint64_t firstSlot) {
        Validation validation = validate(bvh, uint32_t(primitives), bounds, chunks.maxPerId());
        for (Finding& finding : validation.findings) {
            finding.message = name + ": " + finding.message;
            finding.chunk = chunkTypeName(place.chunk);
            if (finding.node == kNowhere || (isBottom && finding.node < 2)) continue;
            finding.node += firstSlot;
            finding.offset = place.of(finding.node).offset;
        }
        chunks.addFindings(std::move(validation.findings), 0);
        depth = std::max(depth, validation.depth);
    };

    // The top level, over the boxes of the instances.
    const TwoLevels levels = form.decodeLevels();
    const PlacedBlases& placed = form.placed();
    std::vector<Aabb> boxes(placed.entries.size());
    for (size_t i = 0; i < boxes.size(); ++i) boxes[placed.instances[i]] = placed.entries[i].bounds;
    validateOne(
        {levels.top.nodes, placed.instances}, boxes.size(),
        [&](std::span<const uint32_t> instances, Aabb* out) {
            for (const uint32_t instance : instances) *out++ = boxes[instance];
        },
        "the top level", topPlace, false, 0);

    // Each BLAS, over the triangles of its mesh.
    const auto separate = separateTrees(levels.bottom, form.primitives());
    if (!separate)
        chunks.fail(FindingId::sharedChildren,
                    "each BLAS must own one run of nodes and one run of triangles, in the order of BLASes");
    for (size_t i = 0; i < separate->trees.size(); ++i) {
        const SceneMesh& mesh = scene.meshes[i];
        const Bvh& tree = separate->trees[i];
        std::vector<uint32_t> own(tree.primitives.begin(), tree.primitives.end());
        for (uint32_t& triangle : own) triangle -= mesh.firstTriangle;  // wraps, and is out of range then
        const Scene meshScene = sceneOfMesh(scene, mesh);
        // A tree's root and its unused slot are not stored among the nodes of the BLASes.
        const uint64_t firstSlot = uint64_t(separate->firstSlots[i]) - 2;
        validateOne({tree.nodes, std::move(own)}, mesh.triangleCount, boundsOfTriangles(meshScene),
                    "BLAS " + std::to_string(i), bottomPlace, true, firstSlot);
    }
    if (chunks.sound() && depth != parameters.depth)
        chunks.fail(FindingId::statedDepth, "the deepest tree has depth " + std::to_string(depth) +
                                                ", but TREE states " + std::to_string(parameters.depth));
}

}  // namespace bvhio
