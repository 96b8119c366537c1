#include "stats/size_stats.h"

#include "core/report.h"

namespace bvhio {

SizeStats sizeStats(const Scene& scene, const EncodedBvh& encoded) {
    SizeStats stats;
    std::visit(
        [&](const auto& form) {
            stats.nodes = form.nodeBytes();
            stats.primitives = form.primitives().size() * sizeof(uint32_t);
        },
        encoded);
    stats.geometry = scene.vertices.size() * sizeof(Vec3) + scene.triangles.size() * sizeof(TriangleIndices) +
                     scene.sourcePrimitives.size() * sizeof(uint32_t) +
                     scene.meshes.size() * sizeof(SceneMesh) + scene.instances.size() * sizeof(SceneInstance);
    stats.triangles = scene.triangles.size();
    return stats;
}

void addTo(Report& report, const SizeStats& stats) {
    report["bytes"] = {
        {"nodes", stats.nodes}, {"primitives", stats.primitives}, {"geometry", stats.geometry}};
    report["bytes_per_primitive"] = stats.nodeBytesPerPrimitive();
    report["total_bytes_per_primitive"] = stats.bytesPerPrimitive();
}

}  // namespace bvhio
