#include "common/query.h"

#include "common/input.h"
#include "common/table.h"
#include "core/error.h"
#include "core/report.h"

namespace bvhio {

QueryTool::QueryTool(CommandLine& line) {
    line.beginPlumbing();
    line.positional("INPUT", input_, "container; - or nothing: standard input");
    line.path("-o,--output", "FILE", outputPath_, "file for the report; -: standard output");
    line.choice("--format", format_, {{"table", "columns, for people"}, {"json", "one JSON object"}},
                "format of the report");
    line.parse();
    refuseTerminalInput(input_);
    output_.emplace(outputPath_, OutputKind::text);
    stages_.emplace(line.tool(), line.progressMode());
}

BvhxFile QueryTool::read() {
    stages_->begin("read", readingKind(input_));
    return readContainer(input_);
}

BvhxFile QueryTool::readOther(const std::string& option, const std::string& path) {
    if (path == "-" && input_ == "-")
        throw Error(ErrorKind::usage, option + ": standard input is already INPUT: name a file");
    refuseTerminalInput(path);
    return readContainer(path);
}

void QueryTool::print(const Report& report) {
    if (isJson()) {
        out() << jsonText(report, 2) << '\n';
        return;
    }
    Report shown = report;
    shown.erase("options");  // the reader of a table has just typed them
    printTable(out(), shown);
}

void QueryTool::finish() {
    stages_->end();
    output_->commit();
}

void OptionalOutput::write(std::span<const std::byte> bytes) {
    output_->stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    output_->commit();
}

void OptionalOutput::write(const std::function<void(std::ostream&)>& writer) {
    writer(output_->stream());
    output_->commit();
}

}  // namespace bvhio
