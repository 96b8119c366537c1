// The chunk of visits (format-spec/visits.md).
#pragma once

#include "file/chunks.h"
#include "tree/bvh.h"

namespace bvhio {

/// Reads the visits of a tree in the aabb form, whose chunks were read just before. Returns nothing if there
/// is no such chunk. Throws FindingError if a pair has more visits than the pair that holds its parent.
SharedArray<uint32_t> readVisits(ChunkSequence& chunks, const Bvh& bvh);

}  // namespace bvhio
