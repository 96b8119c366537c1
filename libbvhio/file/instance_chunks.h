// The chunks of an instanced scene: its meshes and its instances (format-spec/instances.md).
#pragma once

#include "file/chunks.h"
#include "scene/scene.h"

namespace bvhio {

/// The counts in chunk SCEN.
struct InstanceCounts {
    uint32_t meshes = 0, instances = 0;
};

void writeInstances(ContainerWriter& writer, const Scene& scene);

/// Reads meshes and instances into a scene that has its triangles and geometries. Throws FindingError if they
/// break a rule of scene/scene.h.
void readInstances(ChunkSequence& chunks, const InstanceCounts& counts, Scene& scene);

}  // namespace bvhio
