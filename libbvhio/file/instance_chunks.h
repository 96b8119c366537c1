// The chunks of an instanced scene: its meshes and where they stand (format-spec/instances.md).
#pragma once

#include "file/chunks.h"
#include "scene/scene.h"

namespace bvhio {

/// What SCEN says of them.
struct InstanceCounts {
    uint32_t meshes = 0, instances = 0;
};

void writeInstances(ContainerWriter& writer, const Scene& scene);

/// Adds meshes and instances to a scene that has its triangles and geometries; throws FindingError unless
/// they keep every promise of scene/scene.h.
void readInstances(ChunkSequence& chunks, const InstanceCounts& counts, Scene& scene);

}  // namespace bvhio
