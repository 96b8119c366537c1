// The rays that bvh-trace traces, and the order that it traces them in.
#pragma once

#include <cstdint>
#include <vector>

#include "common/trace_options.h"
#include "core/report.h"

namespace bvhio {

struct OrderedRays {
    RaySet set;
    std::vector<uint32_t> order;  // of the set's rays
    std::vector<Ray> traced;      // the set's rays in that order
};

/// Makes a ray set, or reads the file of rays that the options name. Throws Error: usage for too many rays or
/// too small a count; io or invalid for a file that cannot be read or is damaged.
OrderedRays makeRays(const TraceOptions& options, const Scene& scene, const ClosestHits& closestHits);

/// How many rays there are, and for sets that belong to pixels the picture that they were made for: with
/// --count these sets have at most so many rays, because they trace whole pictures.
Report rayReport(const TraceOptions& options, const RaySet& set);

}  // namespace bvhio
