#include "common/command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <thread>

#include "common/log.h"
#include "common/suggest.h"
#include "core/error.h"
#include "core/parallel.h"

namespace bvhio {
namespace {

/// The number's shortest decimal form: 1.2f is 1.2, not 1.2000000476837158.
std::string shortest(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The whole of `text` as a number.
template <class T>
std::optional<T> parseNumber(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
    return value;
}

std::string withDefault(const std::string& help, const std::string& value) {
    return value.empty() ? help : help + " (default " + value + ")";
}

}  // namespace

std::string_view toolsVersion() {
    return BVHIO_VERSION;
}

struct CommandLine::Parser {
    struct Recorded {
        std::string name;
        std::function<Report()> value;
        const CLI::Option* option;
    };

    CLI::App app;
    int argc;
    char** argv;
    std::string group = "Options";
    bool recording = true;
    std::vector<Recorded> recorded;
    std::unique_ptr<ThreadLimit> threadLimit;

    CLI::Option* add(const std::string& names, const std::string& valueName, const std::string& help,
                     std::function<void(const std::string&)> set, std::function<Report()> get) {
        CLI::Option* option = app.add_option_function<std::string>(names, std::move(set), help);
        option->type_name(valueName)->group(group)->take_last();
        if (recording) recorded.push_back({option->get_single_name(), std::move(get), option});
        return option;
    }

    template <class T>
    void addWhole(const std::string& names, T& value, T min, T max, const std::string& help) {
        const std::string name = names.substr(names.rfind(',') + 1);
        add(
            names, "N", value < min ? help : withDefault(help, std::to_string(value)),
            [=, &value](const std::string& text) {
                const auto number = parseNumber<T>(text);
                if (!number || *number < min || *number > max)
                    throw Error(ErrorKind::usage, name + ": '" + text + "' is not a whole number from " +
                                                      std::to_string(min) + " to " + std::to_string(max));
                value = *number;
            },
            [&value, min] { return value < min ? Report() : Report(value); });
    }

    /// `fileName` is empty where a file can't be named.
    void addChoice(const std::string& names, std::string& value, const std::vector<NamedValue>& values,
                   const std::string& fileName, const std::string& help) {
        const std::string name = names.substr(names.rfind(',') + 1);
        std::vector<std::string_view> allowed;
        std::string list = withDefault(help, value) + ":", listed;
        size_t width = 0;
        for (const NamedValue& row : values) width = std::max(width, row.name.size());
        for (size_t i = 0; i < values.size(); ++i) {
            const NamedValue& row = values[i];
            allowed.push_back(row.name);
            list += "\n  " + std::string(row.name) + std::string(width - row.name.size() + 2, ' ') +
                    std::string(row.summary);
            listed += (i == 0                                       ? ""
                       : i + 1 == values.size() && fileName.empty() ? " or "
                                                                    : ", ") +
                      std::string(row.name);
        }
        if (!fileName.empty()) listed += " or " + fileName;
        const auto set = [=, &value](const std::string& text) {
            const bool isFile = !fileName.empty() && text.find_first_of("./") != std::string::npos;
            if (!isFile && std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
                const std::string_view nearest = nearestName(text, allowed);
                throw Error(ErrorKind::usage,
                            name + ": unknown name '" + text + "': " +
                                (nearest.empty() ? "" : "did you mean " + std::string(nearest) + "? ") +
                                "use " + listed);
            }
            value = text;
        };
        add(names, fileName.empty() ? "NAME" : "NAME|" + fileName, list, set,
            [&value] { return value.empty() ? Report() : Report(value); });
    }

    /// The names of all options, for "did you mean".
    std::vector<std::string> optionNames() const {
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        return names;
    }

    [[noreturn]] void refuseExtra(const std::string& extra) const {
        if (extra.size() < 2 || extra[0] != '-')
            throw Error(ErrorKind::usage,
                        "unexpected argument '" + extra + "': see " + app.get_name() + " --help");
        const std::string given = extra.substr(0, extra.find('='));
        const std::vector<std::string> names = optionNames();
        const std::vector<std::string_view> views(names.begin(), names.end());
        const std::string_view nearest = nearestName(given, views);
        throw Error(ErrorKind::usage,
                    "unknown option '" + given +
                        "': " + (nearest.empty() ? "" : "did you mean " + std::string(nearest) + "? ") +
                        "see " + app.get_name() + " --help");
    }
};

CommandLine::CommandLine(const ToolInfo& tool, int argc, char** argv)
    : tool_(tool),
      parser_(new Parser{CLI::App(tool.summary, tool.name), argc, argv, "Options", true, {}, {}}) {
    parser_->app.set_help_flag();  // -h and --help are added last, by parse()
    parser_->app.allow_extras();   // refused in parse(), in words of our own
    parser_->app.get_formatter()->column_width(34);
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
    const std::string name = names.substr(names.rfind(',') + 1);
    parser_->add(
        names, "X", value < min ? help : withDefault(help, shortest(value)),
        [=, &value](const std::string& text) {
            const auto number = parseNumber<float>(text);
            if (!number || !(*number >= min && *number <= max))
                throw Error(ErrorKind::usage, name + ": '" + text + "' is not a number from " +
                                                  shortest(min) + " to " + shortest(max));
            value = *number + 0.0f;  // -0 is 0: files have no -0
        },
        [&value, min] { return value < min ? Report() : Report(*parseNumber<double>(shortest(value))); });
}

void CommandLine::text(const std::string& names, const std::string& valueName, std::string& value,
                       const std::string& help) {
    parser_->add(
        names, valueName, help, [&value](const std::string& text) { value = text; },
        [&value] { return value.empty() ? Report() : Report(value); });
}

void CommandLine::list(const std::string& names, const std::string& valueName, std::string& value,
                       const std::string& help) {
    CLI::Option* option = parser_->add(
        names, valueName, help, [&value](const std::string& text) { value = text; },
        [&value] { return value.empty() ? Report() : Report(value); });
    option->join(',');
}

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
    CLI::Option* option = parser_->app.add_flag_callback(
        names, [&value] { value = true; }, help);
    option->group(parser_->group);
    if (parser_->recording)
        parser_->recorded.push_back({option->get_single_name(), [&value] { return Report(value); }, option});
}

void CommandLine::toggle(const std::string& name, bool& value, const std::string& help) {
    CLI::Option* option =
        parser_->app.add_flag("--" + name + ",!--no-" + name, value, withDefault(help, value ? "on" : "off"));
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

void CommandLine::beginPlumbing() {
    parser_->recording = false;
    parser_->group = "Input, output and the like";
}

void CommandLine::parse() {
    if (parser_->recording) beginPlumbing();
    CLI::App& app = parser_->app;
    std::string progress = "auto";
    uint32_t threads = 0;
    bool verbose = false, quiet = false, help = false, version = false;
    parser_->addWhole("-j,--threads", threads, 0u, UINT32_MAX,
                      "how many threads, at most all of the machine's; 0: all");
    choice("--progress", progress,
           {{"auto", "when standard error is a terminal"},
            {"always", "a line a stage when it is none"},
            {"never", "not at all"}},
           "show progress on standard error");
    flag("-v,--verbose", verbose, "say more on standard error");
    flag("-q,--quiet", quiet, "only errors on standard error");
    flag("--version", version, "print the version and leave");
    flag("-h,--help", help, "print this help and leave");

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
        if (extra != "--" || ended) parser_->refuseExtra(extra);
        ended = true;  // "--" ends the options: what follows may begin with a dash
    }
    if (verbose && quiet) throw Error(ErrorKind::usage, "-v and -q exclude each other: give one");

    setLogLevel(quiet ? LogLevel::quiet : verbose ? LogLevel::verbose : LogLevel::normal);
    progressMode_ = quiet || progress == "never" ? ProgressMode::never
                    : progress == "always"       ? ProgressMode::always
                                                 : ProgressMode::automatic;
    const uint32_t machine = std::max(1u, std::thread::hardware_concurrency());
    parser_->threadLimit = std::make_unique<ThreadLimit>(std::min(threads == 0 ? machine : threads, machine));
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
