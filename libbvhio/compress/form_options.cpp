#include "compress/form_options.h"

#include <charconv>
#include <sstream>

#include "core/error.h"

namespace bvhio {
namespace {

uint32_t parseNumber(const OptionInfo& option, const std::string& text) {
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < option.min ||
        number > option.max)
        throw Error(ErrorKind::usage, std::string(option.name) + ": '" + text +
                                          "' is not a whole number from " + std::to_string(option.min) +
                                          " to " + std::to_string(option.max));
    return number;
}

template <class Form>
const FormOption<typename Form::Options>& findOption(std::string_view name) {
    for (const auto& option : Form::optionTable())
        if (option.name == name) return option;
    throw Error(ErrorKind::usage,
                std::string(name) + ": form " + std::string(Form::kName) + " does not have this option");
}

}  // namespace

OptionValue valueOf(const OptionInfo& option, const std::string& text) {
    switch (option.kind) {
        case OptionKind::number:
            return {parseNumber(option, text)};
        case OptionKind::choice:
            return {indexOfValue(option, text)};
        case OptionKind::text:
            break;
    }
    return {.text = text};
}

uint32_t indexOfValue(const OptionInfo& option, std::string_view name) {
    std::string names;
    for (uint32_t i = 0; i < option.values.size(); ++i) {
        if (option.values[i].name == name) return i;
        names += i == 0 ? "" : i + 1 == option.values.size() ? " or " : ", ";
        names += option.values[i].name;
    }
    throw Error(ErrorKind::usage,
                std::string(option.name) + ": unknown value '" + std::string(name) + "': use " + names);
}

EncodeOptions parseEncodeOptions(std::string_view form, std::string_view words) {
    return visitForm(form, [&]<class Form>(std::type_identity<Form>) -> EncodeOptions {
        typename Form::Options options;
        std::istringstream text{std::string(words)};
        for (std::string name, value; text >> name;) {
            const auto& option = findOption<Form>(name);
            if (!(text >> value)) throw Error(ErrorKind::usage, name + ": the value is missing");
            option.set(options, valueOf(option, value));
        }
        return options;
    });
}

}  // namespace bvhio
