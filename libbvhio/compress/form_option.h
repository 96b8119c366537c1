// How a form describes its options: command lines, provenance, benchmarks and the search for a form follow
// from one table, which stands beside the form.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/named_value.h"

namespace bvhio {

enum class OptionKind : uint8_t { number, choice, text };

/// The value of an option: the number, the index of the chosen name, or the text, as its kind says.
struct OptionValue {
    uint32_t number = 0;
    std::string text{};
};

/// What is to be said of an option, whatever form it belongs to.
struct OptionInfo {
    std::string_view name{};  // "--bits"
    std::string_view help{};  // a noun phrase without the form and the default: "bits per plane"
    OptionKind kind = OptionKind::number;
    uint32_t min = 0, max = 0;                // of a number
    std::span<const NamedValue> values = {};  // of a choice
    std::string_view valueName = {};          // of a text: "auto|ONE[,BOTH]"
    /// The part of the form that uses the option where another form has it as a whole: "mvh BLASes". Empty:
    /// this form is the one that describes it.
    std::string_view part = {};
    /// Tools leave out what is not for everyday use: benchmarks alone have it.
    bool isEveryday = true;
    /// --help and provenance list options by place, then in the order of forms.
    uint32_t place = 0;
};

/// A row of a form's table: an option, and where the form's Options have it.
template <class Options>
struct FormOption : OptionInfo {
    /// Throws Error{usage} for a text that means nothing.
    void (*set)(Options&, const OptionValue&);
    OptionValue (*get)(const Options&);
    /// Whether a tree encoded with such options depends on this one.
    bool (*isUsed)(const Options&) = [](const Options&) { return true; };
};

namespace detail {
template <class Class, class Value>
Class classOfMember(Value Class::*);
}  // namespace detail

/// A row for a number, or an enumeration whose values are the indices of the names, that is a member of
/// Options.
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
