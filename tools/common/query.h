// The frame of a tool that reads a container and prints a report about it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "common/command_line.h"
#include "common/output.h"
#include "core/report.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// Declare the tool's own options first; QueryTool adds INPUT, -o and --format and parses.
class QueryTool {
  public:
    explicit QueryTool(CommandLine& line);

    const std::string& input() const { return input_; }
    bool isJson() const { return format_ == "json"; }
    ProgressBar& stages() { return *stages_; }
    BvhxFile read();
    /// Reads the container that `option` names beside INPUT; standard input can't be both.
    BvhxFile readOther(const std::string& option, const std::string& path);
    /// Where text goes that is no report.
    std::ostream& out() { return output_->stream(); }
    /// Prints the report, as a table or as one JSON object.
    void print(const Report& report);
    /// Ends the output. What was printed is there only now.
    void finish();

  private:
    std::string input_ = "-", outputPath_ = "-", format_ = "table";
    std::optional<ProgressBar> stages_;
    std::optional<Output> output_;
};

/// A file beside the report, written only where its option names one; opened at once, so that a wrong path
/// is found before the work.
class OptionalOutput {
  public:
    explicit OptionalOutput(const std::string& path, OutputKind kind = OutputKind::binary) {
        if (!path.empty()) output_.emplace(path, kind);
    }
    explicit operator bool() const { return output_.has_value(); }
    /// All of it at once; or through the stream, bit by bit, until commit().
    void write(std::span<const std::byte> bytes);
    /// Writes what `writer` does to the stream.
    void write(const std::function<void(std::ostream&)>& writer);
    std::ostream& stream() { return output_->stream(); }
    void commit() { output_->commit(); }

  private:
    std::optional<Output> output_;
};

}  // namespace bvhio
