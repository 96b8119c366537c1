// The common part of tools that write a container: options, stages, provenance and report.
#pragma once

#include <optional>
#include <string>

#include "common/command_line.h"
#include "common/output.h"
#include "common/progress_bar.h"
#include "core/report.h"
#include "file/change_trees.h"

namespace bvhio {

/// Declare the tool's own options first; Pass adds INPUT, -o and --report, and parses. Then call read (in a
/// pass over containers), do the work, and call finish.
class Pass {
  public:
    Pass(CommandLine& line, const std::string& inputName, const std::string& inputHelp);

    const std::string& input() const { return input_; }
    /// Whether a report is wanted.
    bool reports() const { return report_.has_value(); }
    ProgressBar& stages() { return *stages_; }
    /// Reads the container INPUT, or another one, and keeps its cost, the report's sah_before.
    BvhxFile read() { return read(input_); }
    BvhxFile read(const std::string& path);
    /// Sets what provenance and report have as the options, where that is not all of the command line's.
    void recordOptions(const Report& options) { options_ = options; }
    /// Adds the tool's provenance, then writes the container and the report. `work` names the stage whose time
    /// is the report's `seconds`; `extra` is added to the report.
    void finish(BvhxFile& file, const WriteOptions& options, const std::string& work,
                const Report& extra = Report::object());

  private:
    CommandLine& line_;
    std::string input_ = "-", outputPath_ = "-", reportPath_;
    std::optional<ProgressBar> stages_;
    std::optional<Output> output_, report_;
    std::optional<double> sahBefore_;
    std::optional<Report> options_;
};

}  // namespace bvhio
