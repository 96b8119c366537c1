#include "file/visit_chunk.h"

namespace bvhio {

SharedArray<uint32_t> readVisits(ChunkSequence& chunks, const Bvh& bvh) {
    if (!chunks.nextIs(kVisitsType)) return {};
    SharedArray<uint32_t> visits = chunks.expectArray<uint32_t>(kVisitsType, bvh.nodes.size() / 2);
    // In an invalid tree, indices of children may be out of range.
    if (!chunks.sound() || chunks.isTrusted()) return visits;
    std::vector<Finding> findings;
    for (size_t i = 0; i < bvh.nodes.size() && findings.size() < chunks.maxPerId(); ++i) {
        const Node& node = bvh.nodes[i];
        if (i == 1 || node.isLeaf()) continue;
        const uint32_t below = visits[node.left() / 2], own = visits[i / 2];
        if (below > own)
            findings.push_back({FindingId::visits, Finding::Severity::error,
                                "the pair at node " + std::to_string(node.left()) + " has " +
                                    std::to_string(below) + " visits, but the pair of its parent has only " +
                                    std::to_string(own),
                                "VISI", 2 * uint64_t(node.left()), node.left()});
    }
    chunks.addFindings(std::move(findings), chunks.payloadOffset());
    return visits;
}

}  // namespace bvhio
