// Tables of named choices: builders, restructurers, layouts, ray sets and codecs are rows of one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace bvhio {

/// One row: what the command line calls it, one line for --help, and what runs. Command-line choices, help
/// texts, property tests, fuzzing and benchmarks all loop over such rows, so adding one adds it everywhere.
template <class Function>
struct Choice {
    std::string_view name;
    std::string_view summary;
    Function function;
};

/// What a row runs, and the options that it has a use for, as bits that its table names: tools refuse others.
template <class Signature>
struct Method;
template <class Result, class... Arguments>
struct Method<Result(Arguments...)> {
    Result (*run)(Arguments...);
    uint32_t uses;

    Result operator()(Arguments... arguments) const { return run(arguments...); }
};

inline constexpr uint32_t kUsesNothing = 0;

/// The names of a table's rows, as "a, b or c".
template <class Function>
std::string listNames(std::span<const Choice<Function>> table) {
    std::string names;
    for (size_t i = 0; i < table.size(); ++i) {
        if (i > 0) names += i + 1 == table.size() ? " or " : ", ";
        names += table[i].name;
    }
    return names;
}

/// The row called `name`; throws Error{usage} that lists the names when there is none. `what` names the kind
/// of row ("builder").
template <class Function>
const Choice<Function>& choose(std::span<const Choice<Function>> table, std::string_view what,
                               std::string_view name) {
    for (const auto& row : table)
        if (row.name == name) return row;
    throw Error(ErrorKind::usage,
                "unknown " + std::string(what) + " '" + std::string(name) + "': use " + listNames(table));
}

}  // namespace bvhio
