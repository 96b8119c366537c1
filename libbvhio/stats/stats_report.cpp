#include "stats/stats_report.h"

#include <cinttypes>
#include <cstdio>

#include "core/report.h"
#include "stats/hashes.h"
#include "stats/size_stats.h"
#include "stats/slack.h"
#include "stats/tree_stats.h"

namespace bvhio {

std::string hashText(uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

namespace {

/// Returns the statistics of an instanced scene. It has several trees, so there is no layout, slack, overlap
/// or hash.
Report instancedReport(const Scene& scene, const EncodedBvh& encoded, const StatsOptions& options) {
    const InstancedBvh bvh = std::get<TwoLevelForm>(encoded).decodeInstances(scene);
    Report report;
    report["form"] = formNameOf(encoded);
    report["primitives"] = scene.triangles.size();
    report["meshes"] = scene.meshes.size();
    report["instances"] = scene.instances.size();
    report["instanced_primitives"] = scene.primitiveCount();
    addTo(report, treeStats(scene, bvh, options.costs));
    report["epo"] = nullptr;
    addTo(report, sizeStats(scene, encoded));
    report["geometry_hash"] = hashText(geometryHash(scene));
    return report;
}

}  // namespace

Report statsReport(const Scene& scene, const EncodedBvh& encoded, const StatsOptions& options) {
    if (isInstanced(encoded)) return instancedReport(scene, encoded, options);
    const Bvh bvh = std::visit([](const auto& form) { return form.decode(); }, encoded);
    Report report;
    report["form"] = std::visit([](const auto& form) { return form.kName; }, encoded);
    report["layout"] = layoutName(bvh);
    report["primitives"] = scene.triangles.size();
    addTo(report, treeStats(bvh, options.costs));
    addTo(report, slackStats(scene, bvh, options.costs));
    if (options.epo) {
        const Epo overlap = epo(scene, bvh, options.costs, *options.epo);
        report["epo"] = overlap.value;
        report["epo_exact"] = overlap.isExact;
        report["epo_sampled_triangles"] = overlap.sampledTriangles;
        report["epo_standard_error"] = overlap.standardError;
    }
    addTo(report, sizeStats(scene, encoded));
    report["topology_hash"] = hashText(topologyHash(bvh));
    report["bounds_hash"] = hashText(boundsHash(bvh));
    report["geometry_hash"] = hashText(geometryHash(scene));
    return report;
}

}  // namespace bvhio
