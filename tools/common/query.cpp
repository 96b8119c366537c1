#include "common/query.h"

#include "common/input.h"
#include "common/table.h"
#include "core/error.h"

namespace bvhio {

QueryTool::QueryTool(CommandLine& line) {
    line.beginPlumbing();
    line.positional("INPUT", input_, "the container; - or nothing: standard input");
    line.text("-o,--output", "FILE", outputPath_, "where the report goes (default -: standard output)");
    line.choice("--format", format_, {{"table", "for people"}, {"json", "one JSON object"}},
                "how the report is printed");
    line.parse();
    refuseTerminalInput(input_);
    output_.emplace(outputPath_, OutputKind::text);
    stages_.emplace(line.tool(), line.progressMode());
}

BvhxFile QueryTool::read() {
    stages_->begin("read");
    return readBvhx(input_);
}

BvhxFile QueryTool::readOther(const std::string& option, const std::string& path) {
    if (path == "-" && input_ == "-")
        throw Error(ErrorKind::usage, option + ": standard input is INPUT already: name a file");
    refuseTerminalInput(path);
    return readBvhx(path);
}

void QueryTool::print(const Report& report) {
    if (isJson()) {
        out() << jsonText(report, 2) << '\n';
        return;
    }
    Report shown = report;
    shown.erase("options");  // who reads the table has just typed them
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
