#include "common/command_line.h"

#include <cstdio>
#include <utility>

#include "common/cli_parser.h"
#include "common/log.h"

namespace bvhio {
namespace {

/// The number's shortest decimal form: 1.2f is 1.2, not 1.2000000476837158.
std::string shortest(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The number without an exponent, for messages: 1000000, not 1e+06.
std::string decimal(float value) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr};
}

}  // namespace

std::string_view toolsVersion() {
    return BVHIO_VERSION;
}

CommandLine::CommandLine(const ToolInfo& tool, int argc, char** argv)
    : tool_(tool),
      parser_(new Parser{CLI::App(tool.summary, tool.name), argc, argv, "Options", true, {}, {}}) {
    parser_->app.set_help_flag();  // -h and --help are added last, by parse()
    parser_->app.allow_extras();   // refused in parse(), in words of our own
    parser_->app.formatter(std::make_shared<HelpFormatter>());
    if (!tool.examples.empty()) parser_->app.footer("Examples:\n" + tool.examples);
}

CommandLine::~CommandLine() = default;

void CommandLine::positional(const std::string& name, std::string& value, const std::string& help) {
    parser_->app
        .add_option_function<std::string>(
            name, [&value](const std::string& text) { value = text; }, help)
        ->type_name("");
}

void CommandLine::number(const std::string& names, uint32_t& value, uint32_t min, uint32_t max,
                         const std::string& help) {
    parser_->addWhole(names, value, min, max, help);
}

void CommandLine::number(const std::string& names, uint64_t& value, uint64_t min, uint64_t max,
                         const std::string& help) {
    parser_->addWhole(names, value, min, max, help);
}

void CommandLine::number(const std::string& names, float& value, float min, float max,
                         const std::string& help) {
    const std::string name = lastName(names);
    parser_->add(
        names, "X", value < min ? help : withDefault(help, value),
        [=, &value](const std::string& text) {
            const auto number = parseNumber<float>(text);
            if (!number || !(*number >= min && *number <= max))
                throw Error(ErrorKind::usage, name + ": '" + text + "' is not a number from " + decimal(min) +
                                                  " to " + decimal(max));
            value = *number + 0.0f;  // -0 is 0: files have no -0
        },
        [&value, min] { return value < min ? Report() : Report(*parseNumber<double>(shortest(value))); });
}

void CommandLine::text(const std::string& names, const std::string& valueName, std::string& value,
                       const std::string& help) {
    parser_->add(
        names, valueName, withDefault(help, value), [&value](const std::string& text) { value = text; },
        [&value] { return value.empty() ? Report() : Report(value); });
}

void CommandLine::list(const std::string& names, const std::string& valueName, std::string& value,
                       const std::string& help) {
    CLI::Option* option = parser_->add(
        names, valueName, help, [&value](const std::string& text) { value = text; },
        [&value] { return value.empty() ? Report() : Report(value); });
    option->join(',');
}

void CommandLine::path(const std::string& names, const std::string& valueName, std::string& value,
                       const std::string& help) {
    const bool recording = std::exchange(parser_->recording, false);
    text(names, valueName, value, help);
    parser_->recording = recording;
}

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
    CLI::Option* option = parser_->app.add_flag_callback(
        names, [&value] { value = true; }, wrapped(help));
    option->group(parser_->group);
    if (parser_->recording)
        parser_->recorded.push_back({option->get_single_name(), [&value] { return Report(value); }, option});
}

void CommandLine::toggle(const std::string& name, bool& value, const std::string& help) {
    CLI::Option* option = parser_->app.add_flag(
        "--" + name + ",!--no-" + name, value, wrapped(withDefault(help, std::string(value ? "on" : "off"))));
    option->group(parser_->group)->take_last();
    if (parser_->recording) parser_->recorded.push_back({name, [&value] { return Report(value); }, option});
}

void CommandLine::choice(const std::string& names, std::string& value, const std::vector<NamedValue>& values,
                         const std::string& help) {
    parser_->addChoice(names, value, values, "", help);
}

void CommandLine::choiceOrFile(const std::string& names, std::string& value,
                               const std::vector<NamedValue>& values, const std::string& fileName,
                               const std::string& help) {
    parser_->addChoice(names, value, values, fileName, help);
}

void CommandLine::dropped(const std::string& name, const std::string& instead) {
    parser_->dropped[name] = instead;
}

void CommandLine::beginPlumbing() {
    parser_->recording = false;
    parser_->group = "Input and output";
}

void CommandLine::parse() {
    if (parser_->recording) beginPlumbing();
    CLI::App& app = parser_->app;
    std::string progress = "auto";
    uint32_t threads = 0;
    bool verbose = false, quiet = false, help = false, version = false;
    parser_->addWhole("-j,--threads", threads, 0u, UINT32_MAX,
                      "most threads; 0: all that the process may use; the environment's BVHIO_THREADS sets "
                      "it too",
                      "BVHIO_THREADS");
    choice("--progress", progress,
           {{"auto", "on a terminal only"},
            {"always", "also elsewhere: one line for each stage of over a second"},
            {"never", "never"}},
           "progress on standard error");
    flag("-v,--verbose", verbose, "more messages on standard error: what was read, seconds per stage");
    flag("-q,--quiet", quiet, "only errors on standard error");
    flag("--version", version, "print the version and exit");
    flag("-h,--help", help, "print this help and exit");

    try {
        app.parse(parser_->argc, parser_->argv);
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string what = error.what();
        if (!help && !version)
            throw Error(ErrorKind::usage,
                        what.substr(0, what.find(':')) + ": needs a value: see " + tool_.name + " --help");
    } catch (const CLI::Error& error) {
        if (!help && !version)
            throw Error(ErrorKind::usage, std::string(error.what()) + ": see " + tool_.name + " --help");
    }
    if (help || version) {
        const std::string text = help ? app.help() : tool_.name + " " + std::string(toolsVersion()) + "\n";
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
            throw Error(ErrorKind::io, "standard output: cannot be written");
        throw HelpShown{};
    }
    for (bool ended = false; const std::string& extra : app.remaining()) {
        if (extra != "--" || ended) parser_->refuseExtra(extra, extraOption_);
        ended = true;  // "--" ends the options: arguments after it may begin with a dash
    }
    if (verbose && quiet) throw Error(ErrorKind::usage, "-v and -q exclude each other: leave one out");

    setLogLevel(quiet ? LogLevel::quiet : verbose ? LogLevel::verbose : LogLevel::normal);
    progressMode_ = quiet || progress == "never" ? ProgressMode::never
                    : progress == "always"       ? ProgressMode::always
                                                 : ProgressMode::automatic;
    parser_->threadLimit = std::make_unique<ThreadLimit>(threads);
}

std::vector<std::string> CommandLine::given() const {
    std::vector<std::string> names;
    for (const auto& option : parser_->recorded)
        if (option.option->count() > 0) names.push_back("--" + option.name);
    return names;
}

bool CommandLine::isGiven(std::string_view name) const {
    const std::vector<std::string> names = given();
    return std::find(names.begin(), names.end(), name) != names.end();
}

void CommandLine::assign(const std::string& name, const std::string& value) {
    parser_->app.get_option(name)->clear();
    parser_->app.get_option(name)->add_result(value);
    parser_->app.get_option(name)->run_callback();
}

Report CommandLine::options() const {
    Report options = Report::object();
    for (const auto& option : parser_->recorded)
        options[option.name.substr(option.name.find_first_not_of('-'))] = option.value();
    return options;
}

}  // namespace bvhio
