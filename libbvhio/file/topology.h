// A tree as its topology alone (format-spec/topology.md): which nodes are inner, the order of pairs in memory
// and the sizes of leaves. Every box comes back bit by bit from the triangles; those that are not what a
// refit gives are stored as exceptions.
#pragma once

#include "file/tree_chunks.h"
#include "tree/validate.h"

namespace bvhio {

/// TOPO's payload for a valid tree over primitives with these boxes.
std::vector<std::byte> topologyPayload(const Bvh& bvh, const PrimitiveBounds& primitiveBounds);

/// Reads chunk TOPO: the tree over `primitives`, each of them a triangle's index. Boxes are zero where the
/// scene can't be relied on. Throws FindingError unless the payload describes a tree with the counts of
/// `parameters`; whether that tree is valid is left to judgeTree.
Bvh readTopology(ChunkSequence& chunks, const TreeParameters& parameters,
                 const SharedArray<uint32_t>& primitives, const Scene& scene);

}  // namespace bvhio
