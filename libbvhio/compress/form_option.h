// The description of a form's options, a table beside the form. Command lines, provenance, benchmarks and the
// search for a form all use it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/named_value.h"

namespace bvhio {

enum class OptionKind : uint8_t { number, choice, text };

/// The value of an option: a number, the index of the chosen name, or a text. It depends on the kind.
struct OptionValue {
    uint32_t number = 0;
    std::string text{};
};

/// The description of an option of any form.
struct OptionInfo {
    std::string_view name{};  // "--bits"
    std::string_view help{};  // a noun phrase without the form and the default: "bits per plane"
    OptionKind kind = OptionKind::number;
    uint32_t min = 0, max = 0;                // of a number
    std::span<const NamedValue> values = {};  // of a choice
    std::string_view valueName = {};          // of a text: "auto|ONE[,BOTH]"
    /// The part of this form that uses the option, if another form has the option as a whole: "mvh BLASes".
    /// Empty: this form describes the option.
    std::string_view part = {};
    /// Whether tools have the option. Others are only for benchmarks.
    bool isEveryday = true;
    /// --help and provenance list options by place, then in the order of forms.
    uint32_t place = 0;
};

/// A row of a form's table: an option, and how it is stored in the form's Options.
template <class Options>
struct FormOption : OptionInfo {
    /// Sets the option. Throws Error{usage} for a text without meaning.
    void (*set)(Options&, const OptionValue&);
    OptionValue (*get)(const Options&);
    /// Returns whether a tree that is encoded with these options depends on this one.
    bool (*isUsed)(const Options&) = [](const Options&) { return true; };
};

namespace detail {
template <class Class, class Value>
Class classOfMember(Value Class::*);
}  // namespace detail

/// Returns a row for a member of Options: a number, or an enumeration whose values are the indices of the
/// names.
template <auto Member, class Options = decltype(detail::classOfMember(Member))>
constexpr FormOption<Options> memberOption(
    const OptionInfo& info,
    bool (*isUsed)(const std::type_identity_t<Options>&) = [](const Options&) { return true; }) {
    return {info,
            [](Options& options, const OptionValue& value) {
                using Value = std::remove_reference_t<decltype(options.*Member)>;
                options.*Member = Value(value.number);
            },
            [](const Options& options) { return OptionValue{uint32_t(options.*Member)}; }, isUsed};
}

}  // namespace bvhio
