// What files have of an instanced scene's trees beyond the two-level form's own chunks
// (format-spec/two-level.md 8).
#pragma once

#include "compress/two_level_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

/// What TREE says of them: the slots of both levels, and the depth of the deepest tree.
TreeParameters parametersOfInstances(uint32_t formCode, const TwoLevelForm& form);

/// Reads chunk ENTR: which instances the top level's leaves name; each is in range.
SharedArray<uint32_t> readEntries(ChunkSequence& chunks, const Scene& scene);

/// Checks every tree as judgeTree does: the top over the instances, each BLAS over the triangles of its mesh.
void judgeInstances(ChunkSequence& chunks, const TwoLevelForm& form, const TreeParameters& parameters,
                    const Scene& scene, const NodesPlace& top, const NodesPlace& bottom);

}  // namespace bvhio
