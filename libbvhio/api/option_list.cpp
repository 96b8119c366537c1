#include "api/option_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace bvhio {
namespace {

[[noreturn]] void refuseOption(std::string_view name, const std::string& why) {
    throw Error(ErrorKind::usage, "option " + std::string(name) + ": " + why);
}

template <class Text>
std::string alternatives(std::span<const Text> names) {
    std::string list;
    for (size_t i = 0; i < names.size(); ++i) {
        if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
        list += names[i];
    }
    return list;
}

template <class Number>
std::string numberText(Number number) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

template <class Number>
Number parsed(std::string_view name, const std::string& text, Number min, Number max) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !(value >= min && value <= max))
        refuseOption(name,
                     "'" + text + "' is not a number from " + numberText(min) + " to " + numberText(max));
    return value;
}

}  // namespace

OptionList::OptionList(const char* const* texts) {
    for (; texts != nullptr && *texts != nullptr; ++texts) {
        const std::string_view text = *texts;
        const size_t equals = text.find('=');
        if (equals == std::string_view::npos)
            throw Error(ErrorKind::usage, "option '" + std::string(text) + "' is not name=value");
        const std::string_view name = text.substr(0, equals);
        if (isGiven(name)) refuseOption(name, "it is given twice");
        given_.push_back({std::string(name), std::string(text.substr(equals + 1))});
    }
}

const OptionList::Given* OptionList::find(std::string_view name) const {
    for (const Given& option : given_)
        if (option.name == name) return &option;
    return nullptr;
}

bool OptionList::isGiven(std::string_view name) const {
    return find(name) != nullptr;
}

void OptionList::mention(std::string_view name) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) return;
    known_.emplace_back(name);
    mentioned_.emplace_back(name);
}

std::string OptionList::text(std::string_view name, std::string_view standard) {
    known_.emplace_back(name);
    const Given* given = find(name);
    std::string value = given ? given->value : std::string(standard);
    record(name, value);
    return value;
}

uint32_t OptionList::number(std::string_view name, uint32_t standard, uint32_t min, uint32_t max) {
    known_.emplace_back(name);
    const Given* given = find(name);
    const uint32_t value = given ? parsed(name, given->value, min, max) : standard;
    record(name, value);
    return value;
}

float OptionList::number(std::string_view name, float standard, float min, float max) {
    known_.emplace_back(name);
    const Given* given = find(name);
    const float value = given ? parsed(name, given->value, min, max) : standard;
    record(name, value);
    return value;
}

bool OptionList::flag(std::string_view name, bool standard) {
    static constexpr std::string_view kAnswers[] = {"yes", "no"};
    const bool value = choice(name, kAnswers[standard ? 0 : 1], kAnswers) == kAnswers[0];
    record(name, value);
    return value;
}

std::string OptionList::choice(std::string_view name, std::string_view standard,
                               std::span<const std::string_view> names) {
    std::string value = text(name, standard);
    if (isGiven(name) && std::find(names.begin(), names.end(), value) == names.end())
        refuseOption(name, "unknown '" + value + "': use " + alternatives(names));
    return value;
}

void OptionList::refuseUnused(std::string_view name, const std::string& by) const {
    if (isGiven(name)) refuseOption(name, by + " does not use it: leave it out");
}

void OptionList::refuseUnknown() const {
    for (const Given& option : given_)
        if (std::find(known_.begin(), known_.end(), option.name) == known_.end())
            throw Error(ErrorKind::usage, "unknown option '" + option.name + "': use " +
                                              alternatives(std::span<const std::string>(known_)));
}

}  // namespace bvhio
