#include "common/import_summary.h"

#include <initializer_list>
#include <utility>

#include "common/log.h"
#include "core/plural.h"

namespace bvhio {
namespace {

constexpr uint64_t kManyTimes = 4;  // flattening beyond this factor is mentioned

/// The texts whose counts are not 0, as a list.
std::string listOf(std::initializer_list<std::pair<uint64_t, std::string>> parts) {
    std::string list;
    for (const auto& [count, part] : parts)
        if (count > 0) list += (list.empty() ? "" : ", ") + part;
    return list;
}

}  // namespace

ImportCounts countsOf(const ImportedScene& scene) {
    ImportCounts counts;
    counts.meshes = scene.meshes.size();
    counts.instances = scene.instances.size();
    for (const Mesh& mesh : scene.meshes) {
        counts.vertices += mesh.vertices.size();
        counts.triangles += mesh.triangles.size();
    }
    for (const Instance& instance : scene.instances)
        counts.placedTriangles += scene.meshes[instance.mesh].triangles.size();
    counts.leftOut = scene.leftOut;
    return counts;
}

Report reportOf(const ImportCounts& counts) {
    const LeftOut& out = counts.leftOut;
    return {{"read",
             {{"meshes", counts.meshes},
              {"vertices", counts.vertices},
              {"triangles", counts.triangles},
              {"instances", counts.instances},
              {"placed_triangles", counts.placedTriangles}}},
            {"left_out",
             {{"points", out.points},
              {"lines", out.lines},
              {"without_positions", out.withoutPositions},
              {"unused_meshes", out.unusedMeshes},
              {"skins", out.skins},
              {"morph_targets", out.morphTargets},
              {"cameras", out.cameras}}}};
}

std::string summaryOf(const ImportCounts& counts) {
    return "read " + counted(counts.meshes, "mesh", "meshes") + " with " +
           counted(counts.vertices, "vertex", "vertices") + " and " + counted(counts.triangles, "triangle") +
           "; " + counted(counts.instances, "instance") + " with " +
           counted(counts.placedTriangles, "triangle") + " in all";
}

std::string leftOutText(const LeftOut& out, bool withCameras) {
    const std::string left =
        listOf({{out.points, counted(out.points, "primitive") + " of points"},
                {out.lines, counted(out.lines, "primitive") + " of lines"},
                {out.withoutPositions, counted(out.withoutPositions, "primitive") + " without positions"},
                {out.unusedMeshes, counted(out.unusedMeshes, "mesh", "meshes") + " outside the scene"},
                {withCameras ? out.cameras : 0, counted(out.cameras, "camera")}});
    const std::string ignored = listOf({{out.skins, counted(out.skins, "skin")},
                                        {out.morphTargets, counted(out.morphTargets, "morph target")}});
    return (left.empty() ? "" : "left out: " + left) + (left.empty() || ignored.empty() ? "" : "; ") +
           (ignored.empty() ? "" : "not applied: " + ignored);
}

void logImport(const ImportCounts& counts, bool flattens) {
    logInfo(summaryOf(counts));
    const bool isNoted = counts.leftOut.hasGeometry() || counts.leftOut.hasPose();
    const std::string leftOut = leftOutText(counts.leftOut, isVerbose());
    if (!leftOut.empty()) (isNoted ? logNote : logInfo)(leftOut);
    if (flattens && counts.triangles > 0 && counts.placedTriangles > kManyTimes * counts.triangles)
        logNote("instances multiply " + counted(counts.triangles, "triangle") + " to " +
                std::to_string(counts.placedTriangles) + ": --two-level stores each mesh once");
}

}  // namespace bvhio
