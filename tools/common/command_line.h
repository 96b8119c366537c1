// A tool's command line: options are declared one by one, parsed once, and recorded for provenance. Hides
// CLI11.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/help_text.h"
#include "common/progress_bar.h"
#include "core/choice.h"
#include "core/named_value.h"
#include "core/report_fwd.h"

namespace bvhio {

struct ToolInfo {
    std::string name;      // "bvh-build"
    std::string summary;   // one sentence for --help
    std::string examples;  // lines below the options
};

/// The version of the tools, "0.1.0".
std::string_view toolsVersion();

/// Thrown by parse() once --help or --version has been printed.
struct HelpShown {};

template <class Function>
std::vector<NamedValue> namedValues(std::span<const Choice<Function>> table) {
    std::vector<NamedValue> values;
    for (const auto& row : table) values.push_back({row.name, row.summary});
    return values;
}

/// Every option is bound to a variable that holds its default; parse() overwrites it. `names` is "--bins" or
/// "-o,--output". Options are recorded with their values, so that options() says how a file was made.
class CommandLine {
  public:
    CommandLine(const ToolInfo& tool, int argc, char** argv);
    ~CommandLine();

    void positional(const std::string& name, std::string& value, const std::string& help);
    /// A whole number in [min, max]. A default below min means that there is none.
    void number(const std::string& names, uint32_t& value, uint32_t min, uint32_t max,
                const std::string& help);
    void number(const std::string& names, uint64_t& value, uint64_t min, uint64_t max,
                const std::string& help);
    /// A finite number in [min, max]. A default below min means that there is none.
    void number(const std::string& names, float& value, float min, float max, const std::string& help);
    /// An empty default means that there is none.
    void text(const std::string& names, const std::string& valueName, std::string& value,
              const std::string& help);
    /// A text that may be given several times: the parts are joined by commas.
    void list(const std::string& names, const std::string& valueName, std::string& value,
              const std::string& help);
    /// The path of a file. Paths say where data is, not what comes out, so options() leaves them out.
    void path(const std::string& names, const std::string& valueName, std::string& value,
              const std::string& help);
    void flag(const std::string& names, bool& value, const std::string& help);
    /// --NAME and --no-NAME; the last one given counts. options() records it as NAME.
    void toggle(const std::string& name, bool& value, const std::string& help);
    /// One of `values`; the error for a misspelt one suggests the nearest. An empty default means that there
    /// is none.
    void choice(const std::string& names, std::string& value, const std::vector<NamedValue>& values,
                const std::string& help);
    /// One of `values` or any text with a dot or a slash in it: a file.
    void choiceOrFile(const std::string& names, std::string& value, const std::vector<NamedValue>& values,
                      const std::string& fileName, const std::string& help);
    /// An option that older versions had: who gives it reads what to use instead.
    void dropped(const std::string& name, const std::string& instead);
    /// Options declared after this say where things go, not what comes out: options() leaves them out, and
    /// --help lists them separately.
    void beginPlumbing();
    /// The option that a second argument without an option's name was probably meant for: "-o". The error
    /// message suggests it.
    void suggestForExtra(const std::string& option) { extraOption_ = option; }

    /// Adds the options of every tool (threads, verbosity, progress, version, help) and parses; limits the
    /// threads and sets the log level accordingly. Throws Error{usage}, or HelpShown.
    void parse();

    const std::string& tool() const { return tool_.name; }
    /// The options declared before beginPlumbing(), with their values or defaults. Call it after parse().
    Report options() const;
    /// The names of those that the command line has, as "--bins". Call it after parse().
    std::vector<std::string> given() const;
    /// Whether given() has `name`, "--bins".
    bool isGiven(std::string_view name) const;
    /// Sets an option, "--bins", as if the command line had it.
    void assign(const std::string& name, const std::string& value);
    ProgressMode progressMode() const { return progressMode_; }

  private:
    struct Parser;

    ToolInfo tool_;
    std::unique_ptr<Parser> parser_;
    std::string extraOption_;
    ProgressMode progressMode_ = ProgressMode::automatic;
};

}  // namespace bvhio
