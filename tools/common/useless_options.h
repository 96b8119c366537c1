// Options that the chosen builder, method or layout has no use for are refused: who gave them expects
// something of them.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "common/command_line.h"
#include "core/choice.h"
#include "core/error.h"

namespace bvhio {

/// An option, "--bins", and the bits of what has a use for it.
struct OptionUse {
    std::string_view name;
    uint32_t uses;
};

/// Throws Error{usage} for the first of the options that was given though the row of a table, a `what`, has
/// no use for it.
template <class Signature>
void refuseUseless(const CommandLine& line, std::string_view what, const Choice<Method<Signature>>& row,
                   std::initializer_list<OptionUse> options) {
    for (const OptionUse& option : options)
        if ((row.function.uses & option.uses) == 0 && line.isGiven(option.name))
            throw Error(ErrorKind::usage, std::string(option.name) + ": " + std::string(what) + " " +
                                              std::string(row.name) + " has no use for it: leave it out");
}

}  // namespace bvhio
