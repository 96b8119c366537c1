// How many bytes a scene and its encoded tree take in memory, part by part.
#pragma once

#include "compress/forms.h"
#include "core/report.h"
#include "scene/scene.h"

namespace bvhio {

struct SizeStats {
    uint64_t nodes = 0;       // as the form stores them
    uint64_t primitives = 0;  // the leaves' references
    uint64_t geometry = 0;    // vertices, triangles, source numbers, meshes and instances
    uint64_t triangles = 0;   // what the per-primitive figures divide by: those stored

    double nodeBytesPerPrimitive() const { return double(nodes) / double(triangles); }
    double bytesPerPrimitive() const { return double(nodes + primitives + geometry) / double(triangles); }
};

SizeStats sizeStats(const Scene& scene, const EncodedBvh& encoded);

/// Adds the keys bytes{nodes, primitives, geometry}, bytes_per_primitive (of nodes, what forms are compared
/// by) and total_bytes_per_primitive.
void addTo(Report& report, const SizeStats& stats);

}  // namespace bvhio
