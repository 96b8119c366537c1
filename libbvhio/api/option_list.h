// A pass's options as texts, "name=value".
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/choice.h"
#include "core/report.h"

namespace bvhio {

/// A pass reads its options one by one. Each read returns an option's value, or its default if the option was
/// not given, and records both name and value. After all reads, `refuseUnknown` finds given options that were
/// not read. Every error is Error{usage}.
class OptionList {
  public:
    /// `texts` ends with NULL, or is NULL. Throws if a text has no '=' or an option is given twice.
    explicit OptionList(const char* const* texts);

    bool isGiven(std::string_view name) const;
    /// Makes a name known without asking for its value.
    void mention(std::string_view name);
    const std::vector<std::string>& mentioned() const { return mentioned_; }
    std::string text(std::string_view name, std::string_view standard);
    /// Reads a whole number in [min, max].
    uint32_t number(std::string_view name, uint32_t standard, uint32_t min, uint32_t max);
    /// Reads a finite number in [min, max].
    float number(std::string_view name, float standard, float min, float max);
    /// Reads yes or no.
    bool flag(std::string_view name, bool standard);
    /// Reads one of the names. `standard` may be "" if no name is the default.
    std::string choice(std::string_view name, std::string_view standard,
                       std::span<const std::string_view> names);
    /// Reads a name in a table and returns its row. The first row is the default.
    template <class Function>
    const Choice<Function>& row(std::string_view name, std::span<const Choice<Function>> table) {
        return choose(table, name, text(name, table[0].name));
    }

    /// Throws if the option was given, but the row, a `what`, uses none of `uses`.
    template <class Signature>
    void refuseUnused(std::string_view name, std::string_view what, const Choice<Method<Signature>>& row,
                      uint32_t uses) const {
        if ((row.function.uses & uses) == 0)
            refuseUnused(name, std::string(what) + " " + std::string(row.name));
    }
    void refuseUnused(std::string_view name, const std::string& by) const;
    /// Throws for the first given option that was not read, with a list of the options that were.
    void refuseUnknown() const;

    /// Sets the recorded value of an option.
    template <class Value>
    void record(std::string_view name, const Value& value) {
        record_[std::string(name)] = value;
    }
    /// Removes an option from the record.
    void forget(std::string_view name) { record_.erase(std::string(name)); }
    /// Returns every option that was read, with the value that is used.
    const Report& record() const { return record_; }

  private:
    struct Given {
        std::string name, value;
    };
    const Given* find(std::string_view name) const;

    std::vector<Given> given_;
    std::vector<std::string> known_, mentioned_;
    Report record_ = Report::object();
};

}  // namespace bvhio
