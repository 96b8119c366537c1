#include "trace/trace_report.h"

#include "core/report.h"

namespace bvhio {

void addTo(Report& report, const TraceMeasurement& measurement) {
    const TraversalCounts& counts = measurement.counts;
    report["NC"] = counts.nc();
    report["LC"] = counts.lc();
    report["TC"] = counts.tc();
    report["AOC"] = counts.aoc();
    report["AOC_arithmetic"] = counts.perRay(counts.boxArithmetic);
    report["AOC_comparisons"] = counts.perRay(counts.boxComparisons);
    report["BLB"] = counts.blb();
    report["LCV"] = counts.lcv();
    report["records"] = counts.perRay(counts.records);
    report["SOC"] = counts.soc();
    report["SBL"] = counts.sbl();
    for (size_t i = 0; i < kLocalitySizes.size(); ++i) {
        const std::string size = std::to_string(kLocalitySizes[i]);
        report["LJC"][size] = counts.perRay(measurement.locality.longJumps[i]);
        report["CMC"][size] = counts.perRay(measurement.locality.blockChanges[i]);
        report["WSS"][size] = measurement.locality.workingSet[i];
    }
}

}  // namespace bvhio
