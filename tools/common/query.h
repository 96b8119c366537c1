// The common part of tools that read a container and print a report about it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "common/command_line.h"
#include "common/output.h"
#include "core/report_fwd.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// Declare the tool's own options first; QueryTool adds INPUT, -o and --format, and parses.
class QueryTool {
  public:
    explicit QueryTool(CommandLine& line);

    const std::string& input() const { return input_; }
    bool isJson() const { return format_ == "json"; }
    ProgressBar& stages() { return *stages_; }
    BvhxFile read();
    /// Reads the container that `option` names beside INPUT; only one of them may be standard input.
    BvhxFile readOther(const std::string& option, const std::string& path);
    /// For text that is not a report.
    std::ostream& out() { return output_->stream(); }
    bool printsToTerminal() const { return output_->isTerminal(); }
    /// Prints the report, as a table or as one JSON object.
    void print(const Report& report);
    /// Ends the output. Only now the text is complete in its file.
    void finish();

  private:
    std::string input_ = "-", outputPath_ = "-", format_ = "table";
    std::optional<ProgressBar> stages_;
    std::optional<Output> output_;
};

/// A file beside the report, written only where its option names one. It is opened at once, so that a wrong
/// path is reported before the work.
class OptionalOutput {
  public:
    explicit OptionalOutput(const std::string& path, OutputKind kind = OutputKind::binary) {
        if (!path.empty()) output_.emplace(path, kind);
    }
    explicit operator bool() const { return output_.has_value(); }
    /// Writes all of it at once. The stream takes it bit by bit, until commit().
    void write(std::span<const std::byte> bytes);
    /// Writes what `writer` writes to the stream.
    void write(const std::function<void(std::ostream&)>& writer);
    std::ostream& stream() { return output_->stream(); }
    void commit() { output_->commit(); }

  private:
    std::optional<Output> output_;
};

}  // namespace bvhio
