// Options of forms by their names and values, as command lines have them.
#pragma once

#include <string>
#include <string_view>

#include "compress/forms.h"

namespace bvhio {

/// The options of the form called `form` that words such as "--tlas-form aabb --blas-size 16" ask for; those
/// that are not named have their defaults. Throws Error{usage} in one line for an unknown form, an option
/// that the form does not have, and a value that is out of range.
EncodeOptions parseEncodeOptions(std::string_view form, std::string_view words);

/// The default of an option as the command line takes it: "8", "quantized" or "auto".
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

/// The index of the name among the option's values. Throws Error{usage} when it is none of them.
uint32_t indexOfValue(const OptionInfo& option, std::string_view name);

}  // namespace bvhio
