// Chunk CLUS, which follows an aabb tree and maps its pairs to clusters: format-spec/clusters.md.
#pragma once

#include "file/chunks.h"
#include "tree/bvh.h"

namespace bvhio {

/// Writes the chunk, or nothing if the map is empty.
void writeClusters(ContainerWriter& writer, const SlotMap& slots);
/// Reads the chunk, which must be the next one, into bvh.slots. Throws FindingError if it does not match the
/// tree.
void readClusters(ChunkSequence& chunks, Bvh& bvh);

}  // namespace bvhio
