// Rejects options that the chosen builder, method or layout does not use: whoever gives one expects an
// effect.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "common/command_line.h"
#include "core/choice.h"
#include "core/error.h"

namespace bvhio {

/// An option, "--bins", and a bit mask of the methods that use it.
struct OptionUse {
    std::string_view name;
    uint32_t uses;
};

/// Throws Error{usage} for the first option that was given though `row` does not use it. `what` is the noun
/// of the row's table: "builder".
template <class Signature>
void refuseUnused(const CommandLine& line, std::string_view what, const Choice<Method<Signature>>& row,
                  std::initializer_list<OptionUse> options) {
    for (const OptionUse& option : options)
        if ((row.function.uses & option.uses) == 0 && line.isGiven(option.name))
            throw Error(ErrorKind::usage, std::string(option.name) + ": " + std::string(what) + " " +
                                              std::string(row.name) + " does not use it: leave it out");
}

}  // namespace bvhio
