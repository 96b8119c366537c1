#include "common/pass.h"

#include "common/input.h"
#include "common/log.h"
#include "common/machine.h"
#include "core/parallel.h"
#include "core/report.h"
#include "stats/tree_stats.h"

namespace bvhio {

Pass::Pass(CommandLine& line, const std::string& inputName, const std::string& inputHelp) : line_(line) {
    line.beginPlumbing();
    line.positional(inputName, input_, inputHelp);
    line.path("-o,--output", "FILE", outputPath_, "file for the container; -: standard output");
    line.path("--report", "FILE", reportPath_, "file for a report as JSON; -: standard output");
    line.suggestForExtra("-o");
    line.parse();
    refuseTerminalInput(input_);
    if (reportPath_ == "-" && outputPath_ == "-")
        throw Error(ErrorKind::usage, "--report: the container goes to standard output: use -o FILE");
    output_.emplace(outputPath_, OutputKind::binary);
    if (!reportPath_.empty()) report_.emplace(reportPath_, OutputKind::text);
    stages_.emplace(line.tool(), line.progressMode());
}

BvhxFile Pass::read(const std::string& path) {
    stages_->begin("read", readingKind(path));
    BvhxFile file = readContainer(path);
    sahBefore_ = sahCost(file.scene, file.bvh, file.costs);
    return file;
}

void Pass::finish(BvhxFile& file, const WriteOptions& options, const std::string& work, const Report& extra) {
    stages_->begin("write", output_->isPipe() ? StageKind::waiting : StageKind::working);
    const Report recorded = options_ ? *options_ : line_.options();
    file.provenance.push_back({line_.tool(), std::string(toolsVersion()), jsonText(recorded)});
    const std::optional<EncodedBvh> refitted = writeBvhx(output_->stream(), file, options);
    output_->commit();
    stages_->end();
    for (const auto& [stage, seconds] : stages_->stages())
        logInfo(stage + ": " + std::to_string(seconds) + " s");
    if (!report_) return;

    Report report = {{"tool", line_.tool()}, {"version", std::string(toolsVersion())}};
    report["sah_before"] = sahBefore_ ? Report(*sahBefore_) : Report();
    report["sah_after"] = sahCost(file.scene, refitted ? *refitted : file.bvh, file.costs);
    report["seconds"] = stages_->seconds(work);
    for (const auto& [stage, seconds] : stages_->stages()) report["stage_seconds"][stage] = seconds;
    report["threads"] = threadCount();
    report["peak_bytes"] = peakBytes();
    report["options"] = recorded;
    report.update(extra);
    report_->stream() << jsonText(report, 2) << '\n';
    report_->commit();
}

}  // namespace bvhio
