#include "file/tree_chunks.h"

#include "scene/triangle_bounds.h"
#include "tree/validate.h"

namespace bvhio {

void validateTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
                  const std::function<NodesPlace(uint64_t node)>& placeOf) {
    if (chunks.isTrusted()) return;
    Validation validation =
        validate(bvh, uint32_t(scene.triangles.size()),
                 chunks.sound() ? boundsOfTriangles(scene) : PrimitiveBounds{}, chunks.maxPerId());
    for (Finding& finding : validation.findings) {
        const NodesPlace place = placeOf(finding.node == kNowhere ? 0 : finding.node);
        finding.chunk = chunkTypeName(place.chunk);
        if (finding.node != kNowhere) finding.offset = place.offset;
    }
    if (validation.findings.empty() && validation.depth != parameters.depth)
        chunks.fail(FindingId::statedDepth, "the tree has depth " + std::to_string(validation.depth) +
                                                ", but TREE states " + std::to_string(parameters.depth));
    chunks.addFindings(std::move(validation.findings), 0);
}

void validateTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
                  uint64_t nodesOffset, size_t nodeSize, uint32_t chunk) {
    const NodesPlace nodes{chunk, nodesOffset, nodeSize};
    validateTree(chunks, bvh, parameters, scene, [&](uint64_t node) { return nodes.of(node); });
}

void writeBox(ByteWriter& bytes, const Aabb& box) {
    for (const Vec3& corner : {box.min, box.max})
        for (int axis = 0; axis < 3; ++axis) bytes.f32(corner[axis]);
}

Aabb readBox(ByteReader& reader) {
    Aabb box;
    for (Vec3* corner : {&box.min, &box.max})
        for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.f32();
    return box;
}

}  // namespace bvhio
