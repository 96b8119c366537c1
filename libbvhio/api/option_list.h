// The options that a pass is given as texts, "name=value".
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/choice.h"
#include "core/report.h"

namespace bvhio {

/// Each question takes an option's value, or its default where it was not given, and remembers both the name
/// and the value. After all questions `refuseUnknown` finds what nobody asked for. Every error is
/// Error{usage}.
class OptionList {
  public:
    /// `texts` ends with NULL, or is NULL. Throws for a text without '=' and for an option given twice.
    explicit OptionList(const char* const* texts);

    bool isGiven(std::string_view name) const;
    std::string text(std::string_view name, std::string_view standard);
    /// A whole number in [min, max].
    uint32_t number(std::string_view name, uint32_t standard, uint32_t min, uint32_t max);
    /// A finite number in [min, max].
    float number(std::string_view name, float standard, float min, float max);
    /// yes or no.
    bool flag(std::string_view name, bool standard);
    /// One of the names; "" as a standard stands for none of them.
    std::string choice(std::string_view name, std::string_view standard,
                       std::span<const std::string_view> names);
    /// The row of a table; the first is the standard.
    template <class Function>
    const Choice<Function>& row(std::string_view name, std::span<const Choice<Function>> table) {
        return choose(table, name, text(name, table[0].name));
    }

    /// Throws when the option was given though the row, a `what`, has none of the uses.
    template <class Signature>
    void refuseUnused(std::string_view name, std::string_view what, const Choice<Method<Signature>>& row,
                      uint32_t uses) const {
        if ((row.function.uses & uses) == 0)
            refuseUnused(name, std::string(what) + " " + std::string(row.name));
    }
    void refuseUnused(std::string_view name, const std::string& by) const;
    /// Throws for the first option that nobody asked for, and lists those that somebody did.
    void refuseUnknown() const;

    /// Sets what the record says of an option.
    template <class Value>
    void record(std::string_view name, const Value& value) {
        record_[std::string(name)] = value;
    }
    /// Leaves an option out of the record.
    void forget(std::string_view name) { record_.erase(std::string(name)); }
    /// Every option that was asked for with the value that counts.
    const Report& record() const { return record_; }

  private:
    struct Given {
        std::string name, value;
    };
    const Given* find(std::string_view name) const;

    std::vector<Given> given_;
    std::vector<std::string> known_;
    Report record_ = Report::object();
};

}  // namespace bvhio
