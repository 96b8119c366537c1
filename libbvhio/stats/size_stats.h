// The sizes in memory of a scene and its encoded tree, part by part.
#pragma once

#include "compress/forms.h"
#include "core/report_fwd.h"
#include "scene/scene.h"

namespace bvhio {

struct SizeStats {
    uint64_t nodes = 0;       // bytes, as the form stores them
    uint64_t primitives = 0;  // bytes of the leaves' references
    uint64_t geometry = 0;    // bytes of vertices, triangles, source numbers, meshes and instances
    uint64_t triangles = 0;   // stored triangles, the divisor of the figures per primitive

    double nodeBytesPerPrimitive() const { return double(nodes) / double(triangles); }
    double bytesPerPrimitive() const { return double(nodes + primitives + geometry) / double(triangles); }
};

SizeStats sizeStats(const Scene& scene, const EncodedBvh& encoded);

/// Adds the keys bytes{nodes, primitives, geometry}, bytes_per_primitive (of nodes, for comparing forms) and
/// total_bytes_per_primitive.
void addTo(Report& report, const SizeStats& stats);

}  // namespace bvhio
