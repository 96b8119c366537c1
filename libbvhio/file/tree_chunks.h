// What the chunks of every form share (format-spec/chunks.md 7), and what a form adds: a specialisation of
// FormChunks in a file of its own, included by file/form_chunks.cpp.
#pragma once

#include <functional>

#include "core/bytes.h"
#include "file/chunks.h"
#include "tree/depth.h"

namespace bvhio {

/// What every form's tree has.
struct TreeParameters {
    uint32_t form = 0;
    uint64_t nodeSlots = 0, references = 0;
    SahCosts costs;
    uint32_t depth = 0;
};

/// Checks a tree that was read, boxes as its form reconstructs them, against every rule of tree/bvh.h. Its
/// nodes are records of `nodeSize` bytes from `nodesOffset` on, in a chunk of this type.
void judgeTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
               uint64_t nodesOffset, size_t nodeSize, uint32_t chunk = kNodesType);

/// Where an array of nodes is in a file.
struct NodesPlace {
    uint32_t chunk;
    uint64_t offset;
    size_t nodeSize;

    NodesPlace of(uint64_t node) const { return {chunk, offset + node * nodeSize, nodeSize}; }
};
/// The same for nodes in several arrays: `placeOf` tells where one is.
void judgeTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
               const std::function<NodesPlace(uint64_t node)>& placeOf);

/// Checks the tree of a form as judgeTree does, with boxes as the form reconstructs them; of a trusted file
/// it decodes nothing. `where` is what judgeTree takes behind the scene.
template <class F, class... Where>
void judgeForm(ChunkSequence& chunks, const F& form, const TreeParameters& parameters, const Scene& scene,
               const Where&... where) {
    if (!chunks.isTrusted()) judgeTree(chunks, form.decode(), parameters, scene, where...);
}

/// How one form is stored: specialised for each, with
/// - kCode: TREE's form field,
/// - parameters(form): what TREE says, but for the costs,
/// - write(writer, form): the chunks behind TREE,
/// - read(chunks, parameters, scene): reads those; throws FindingError unless the tree is valid.
template <class F>
struct FormChunks;

}  // namespace bvhio
