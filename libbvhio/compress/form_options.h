// Reads and writes options of forms as texts of command lines.
#pragma once

#include <string>
#include <string_view>

#include "compress/forms.h"

namespace bvhio {

/// Parses options of the form called `form`, such as "--tlas-form aabb --blas-size 16". Options that are not
/// in the text have their defaults. Throws Error{usage} for an unknown form, an option that the form does not
/// have, and a value out of range.
EncodeOptions parseEncodeOptions(std::string_view form, std::string_view words);

/// Returns the default of an option as on a command line: "8", "quantized" or "auto".
template <class Options>
std::string defaultText(const FormOption<Options>& option) {
    const OptionValue value = option.get(Options{});
    switch (option.kind) {
        case OptionKind::number:
            return std::to_string(value.number);
        case OptionKind::choice:
            return std::string(option.values[value.number].name);
        case OptionKind::text:
            break;
    }
    return value.text;
}

/// Returns the value that the text stands for. Throws Error{usage} for a number out of range and an unknown
/// name.
OptionValue valueOf(const OptionInfo& option, const std::string& text);

/// Returns the index of the name among the option's values. Throws Error{usage} if it is not one of them.
uint32_t indexOfValue(const OptionInfo& option, std::string_view name);

}  // namespace bvhio
