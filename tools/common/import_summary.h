// What bvh-build says of the scene that it read.
#pragma once

#include <string>

#include "core/report.h"
#include "importers/import.h"

namespace bvhio {

/// The numbers of an imported scene, before flattening.
struct ImportCounts {
    uint64_t meshes = 0;  // mesh primitives with different data
    uint64_t vertices = 0, triangles = 0;
    uint64_t instances = 0;        // places of these meshes
    uint64_t placedTriangles = 0;  // counted as often as they are placed
    LeftOut leftOut;
};
ImportCounts countsOf(const ImportedScene& scene);

/// For the JSON report: `read` and `left_out`.
Report reportOf(const ImportCounts& counts);

/// One line for -v.
std::string summaryOf(const ImportCounts& counts);
/// "left out: 2 primitives of lines; not applied: 1 skin"; "" where the scene is complete. Cameras are listed
/// on request only: nobody misses them in a tree.
std::string leftOutText(const LeftOut& out, bool withCameras);

/// Reports to standard error what was read (with -v), what was left out or not applied, and, where the scene
/// is flattened, that its instances multiply its triangles more than fourfold.
void logImport(const ImportCounts& counts, bool flattens);

}  // namespace bvhio
