// The common part of all forms' chunks (format-spec/chunks.md 7). Each form adds a specialization of
// FormChunks in its own file, which file/form_chunks.cpp includes.
#pragma once

#include <functional>

#include "core/bytes.h"
#include "file/chunks.h"
#include "scene/scene.h"
#include "tree/depth.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The fields of TREE, which a tree of any form has.
struct TreeParameters {
    uint32_t form = 0;
    uint64_t nodeSlots = 0, references = 0;
    SahCosts costs;
    uint32_t depth = 0;
};

/// Checks a tree that was read, with the boxes that its form reconstructs, against every rule of tree/bvh.h.
/// Its nodes are records of `nodeSize` bytes that start at byte `nodesOffset`, in a chunk of this type.
void validateTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
                  uint64_t nodesOffset, size_t nodeSize, uint32_t chunk = kNodesType);

/// The place of an array of nodes in a file.
struct NodesPlace {
    uint32_t chunk;
    uint64_t offset;
    size_t nodeSize;

    NodesPlace of(uint64_t node) const { return {chunk, offset + node * nodeSize, nodeSize}; }
};
/// Checks a tree with nodes in several arrays. `placeOf` returns the place of a node.
void validateTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
                  const std::function<NodesPlace(uint64_t node)>& placeOf);

/// Decodes a form's tree and checks it with validateTree, which gets `where` after the scene. Does nothing
/// for a trusted file.
template <class F, class... Where>
void validateForm(ChunkSequence& chunks, const F& form, const TreeParameters& parameters, const Scene& scene,
                  const Where&... where) {
    if (!chunks.isTrusted()) validateTree(chunks, form.decode(), parameters, scene, where...);
}

/// Writes or reads a box as six floats: min x, y, z, max x, y, z.
void writeBox(ByteWriter& bytes, const Aabb& box);
Aabb readBox(ByteReader& reader);

/// The storage of a form. There is a specialization for each, with
/// - kCode: TREE's form field,
/// - parameters(form): returns the fields of TREE, except for the costs,
/// - write(writer, form): writes the chunks after TREE,
/// - read(chunks, parameters, scene): reads these. Throws FindingError unless the tree is valid.
template <class F>
struct FormChunks;

}  // namespace bvhio
