// The storage of an instanced scene's trees, in addition to the two-level form's own chunks
// (format-spec/two-level.md 8).
#pragma once

#include "compress/two_level_form.h"
#include "file/tree_chunks.h"

namespace bvhio {

/// Returns the fields of TREE: the slots of both levels, and the depth of the deepest tree.
TreeParameters parametersOfInstances(uint32_t formCode, const TwoLevelForm& form);

/// Reads chunk ENTR, the instances of the top level's leaves. Throws FindingError if one is out of range.
SharedArray<uint32_t> readEntries(ChunkSequence& chunks, const Scene& scene);

/// Checks every tree like validateTree: the top level over the instances, each BLAS over its mesh's
/// triangles.
void validateInstances(ChunkSequence& chunks, const TwoLevelForm& form, const TreeParameters& parameters,
                       const Scene& scene, const NodesPlace& top, const NodesPlace& bottom);

}  // namespace bvhio
