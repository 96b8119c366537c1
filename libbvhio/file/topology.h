// Stores a tree as its topology alone (format-spec/topology.md): which nodes are inner, the order of pairs in
// memory and the sizes of leaves. Every box is restored bit by bit from the triangles. Boxes that differ from
// those of a refit are stored as exceptions.
#pragma once

#include "file/tree_chunks.h"
#include "tree/validate.h"

namespace bvhio {

/// Returns the payload of TOPO for a valid tree over primitives with these boxes.
std::vector<std::byte> topologyPayload(const Bvh& bvh, const PrimitiveBounds& primitiveBounds);

/// Reads chunk TOPO: the tree over `primitives`, each of which is the index of a triangle. If the scene has
/// faults, boxes stay zero. Throws FindingError if the payload does not describe a tree with the counts of
/// `parameters`. Whether that tree is valid is checked later, with the trees of all forms.
Bvh readTopology(ChunkSequence& chunks, const TreeParameters& parameters,
                 const SharedArray<uint32_t>& primitives, const Scene& scene);

}  // namespace bvhio
