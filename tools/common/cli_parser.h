// How CommandLine uses CLI11: the only file that includes it.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/suggest.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/report.h"

namespace bvhio {

/// The whole of `text` as a number.
template <class T>
std::optional<T> parseNumber(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
    return value;
}

/// The name that messages call an option by: the last of "-o,--output".
inline std::string lastName(const std::string& names) {
    return names.substr(names.rfind(',') + 1);
}

/// Lists a toggle as "--NAME,--no-NAME", without CLI11's "{false}".
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(kHelpColumn); }
    std::string make_option_name(const CLI::Option* option, bool isPositional) const override {
        std::string name = CLI::Formatter::make_option_name(option, isPositional);
        if (name.ends_with("{false}")) name.resize(name.size() - 7);
        return name;
    }
};

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
    std::map<std::string, std::string> dropped{};  // what to use instead, by name

    CLI::Option* add(const std::string& names, const std::string& valueName, const std::string& help,
                     std::function<void(const std::string&)> set, std::function<Report()> get) {
        CLI::Option* option = app.add_option_function<std::string>(names, std::move(set), wrapped(help));
        option->type_name(valueName)->group(group)->take_last();
        if (recording) recorded.push_back({option->get_single_name(), std::move(get), option});
        return option;
    }

    /// `environment` names the variable that sets the number where no option does.
    template <class T>
    void addWhole(const std::string& names, T& value, T min, T max, const std::string& help,
                  const char* environment = "") {
        const std::string name = lastName(names);
        CLI::Option* option = add(
            names, "N", value < min ? help : withDefault(help, value),
            [=, &value](const std::string& text) {
                const auto number = parseNumber<T>(text);
                const char* variable = std::getenv(environment);
                const bool isVariables = variable != nullptr && variable == text;
                if (!number || *number < min || *number > max)
                    throw Error(ErrorKind::usage, (isVariables ? environment : name) + ": '" + text +
                                                      "' is not a whole number from " + std::to_string(min) +
                                                      " to " + std::to_string(max));
                value = *number;
            },
            [&value, min] { return value < min ? Report() : Report(value); });
        option->envname(environment)->option_text("N");
    }

    /// `fileName` is empty where a file can't be named.
    void addChoice(const std::string& names, std::string& value, const std::vector<NamedValue>& values,
                   const std::string& fileName, const std::string& help) {
        const std::string name = lastName(names);
        const auto set = [=, &value](const std::string& text) {
            const bool isFile = !fileName.empty() && text.find_first_of("./") != std::string::npos;
            std::vector<std::string_view> allowed;
            for (const NamedValue& row : values) allowed.push_back(row.name);
            if (!isFile && std::find(allowed.begin(), allowed.end(), text) == allowed.end())
                throw Error(ErrorKind::usage, name + ": unknown name '" + text +
                                                  "': " + didYouMean(text, allowed) + "use " +
                                                  listValues(values, fileName));
            value = text;
        };
        CLI::Option* option = add(names, fileName.empty() ? "NAME" : "NAME|" + fileName, "", set,
                                  [&value] { return value.empty() ? Report() : Report(value); });
        option->description(wrapped(withDefault(help, value) + ":") + valueRows(values));
    }

    /// The names of all options, for "did you mean".
    std::vector<std::string> optionNames() const {
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        return names;
    }

    static std::string didYouMean(const std::string& given, std::span<const std::string_view> names) {
        const std::string_view nearest = nearestName(given, names);
        return nearest.empty() ? "" : "did you mean " + std::string(nearest) + "? ";
    }

    /// `suggested` is the option that an argument without a name was probably meant for, or "".
    [[noreturn]] void refuseExtra(const std::string& extra, const std::string& suggested) const {
        const std::string seeHelp = "see " + app.get_name() + " --help";
        if (extra.size() < 2 || extra[0] != '-') {
            const std::string what = "unexpected argument '" + extra + "': ";
            throw Error(ErrorKind::usage, what + (extra.ends_with(".bvhx") && !suggested.empty()
                                                      ? "use " + suggested + " " + extra
                                                      : "only one input is read: " + seeHelp));
        }
        const std::string given = extra.substr(0, extra.find('='));
        if (const auto old = dropped.find(given); old != dropped.end())
            throw Error(ErrorKind::usage, "unknown option '" + given + "': use " + old->second);
        const std::vector<std::string> names = optionNames();
        const std::vector<std::string_view> views(names.begin(), names.end());
        throw Error(ErrorKind::usage,
                    "unknown option '" + given + "': " + didYouMean(given, views) + seeHelp);
    }
};

}  // namespace bvhio
