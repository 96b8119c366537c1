// Reports the counts of a run as JSON.
#pragma once

#include "core/report_fwd.h"
#include "trace/trace.h"

namespace bvhio {

/// Adds the keys NC LC TC AOC AOC_arithmetic AOC_comparisons BLB LCV records SOC SBL LJC{T} CMC{T} WSS{T}, as
/// defined in metrics/metrics.h and metrics/locality.h.
void addTo(Report& report, const TraceMeasurement& measurement);

}  // namespace bvhio
