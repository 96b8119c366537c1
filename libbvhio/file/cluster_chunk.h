// The chunk CLUS beside an aabb tree, which says how its pairs lie in clusters: format-spec/clusters.md.
#pragma once

#include "file/chunks.h"
#include "tree/bvh.h"

namespace bvhio {

/// Writes nothing for an empty map.
void writeClusters(ContainerWriter& writer, const SlotMap& slots);
/// Reads the chunk, which is the next one, to bvh.slots; throws FindingError unless it fits the tree.
void readClusters(ChunkSequence& chunks, Bvh& bvh);

}  // namespace bvhio
