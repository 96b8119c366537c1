// The options of bvh-trace.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "metrics/cache_model.h"
#include "rays/ray_sets.h"

namespace bvhio {

struct TraceOptions {
    std::string rays, rayOrder, nodeStorage;  // names of rows, or a file of rays; no node storage: ""
    RaySetOptions set;
    bool anyHit = false;
    uint32_t repeat = 3;
    std::string compare;
    float tolerance = 0;
    std::vector<CacheLevels> caches;
    uint32_t heatmapScale = 0;  // the cost that is drawn as white; 0: found from the picture
    std::string fetches, saveRays, recordVisits, hits, image, heatmap;  // files to write; "": none
};

/// Declares the options on a command line, and turns what was given into TraceOptions.
class TraceCommandLine {
  public:
    explicit TraceCommandLine(CommandLine& line);
    /// Throws Error{usage} for a malformed resolution, camera or cache, for a picture whose file name does
    /// not end in .png, and for a scale without a heat map. Call it after parse().
    const TraceOptions& options();

  private:
    TraceOptions options_;
    std::string resolution_, camera_, cache_;
};

}  // namespace bvhio
