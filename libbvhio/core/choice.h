// Tables of named choices. Builders, restructurers, layouts, ray sets and codecs have a table each.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace bvhio {

/// A row: its name on the command line, one line for --help, and its function. Command-line choices, help
/// texts, property tests, fuzzing and benchmarks loop over the rows, so a new row appears in all of them.
template <class Function>
struct Choice {
    std::string_view name;
    std::string_view summary;
    Function function;
};

/// A method, and a mask of the options it uses (the bits are beside its table). Tools reject other options.
template <class Signature>
struct Method;
template <class Result, class... Arguments>
struct Method<Result(Arguments...)> {
    Result (*run)(Arguments...);
    uint32_t uses;

    Result operator()(Arguments... arguments) const { return run(arguments...); }
};

inline constexpr uint32_t kUsesNothing = 0;

/// Returns the names of a table's rows as "a, b or c".
template <class Function>
std::string listNames(std::span<const Choice<Function>> table) {
    std::string names;
    for (size_t i = 0; i < table.size(); ++i) {
        if (i > 0) names += i + 1 == table.size() ? " or " : ", ";
        names += table[i].name;
    }
    return names;
}

/// Returns the row called `name`. Throws Error{usage} with a list of all names if there is no such row.
/// `what` names the kind of row ("builder").
template <class Function>
const Choice<Function>& choose(std::span<const Choice<Function>> table, std::string_view what,
                               std::string_view name) {
    for (const auto& row : table)
        if (row.name == name) return row;
    throw Error(ErrorKind::usage,
                "unknown " + std::string(what) + " '" + std::string(name) + "': use " + listNames(table));
}

}  // namespace bvhio
