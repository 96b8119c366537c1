// The words of --help.
#pragma once

#include <charconv>
#include <concepts>
#include <span>
#include <string>
#include <string_view>

#include "core/named_value.h"

namespace bvhio {

/// `help` with " (default VALUE)" behind it, or alone when `value` is empty.
std::string withDefault(const std::string& help, const std::string& value);

/// The same for a number, in its shortest decimal form: 1.2f is 1.2, not 1.2000000476837158.
template <class Number>
requires std::integral<Number> || std::floating_point<Number> std::string withDefault(const std::string& help,
                                                                                      Number value) {
    char text[32];
    return withDefault(help, std::string(text, std::to_chars(text, text + sizeof text, value).ptr));
}

/// The text in lines that fit beside the option's name, with line feeds between them. Lines after the first
/// begin with `indent` spaces.
std::string wrapped(std::string_view text, size_t indent = 0);

/// A row for each value, below an option's help: its name and its summary, in columns.
std::string valueRows(std::span<const NamedValue> values);

/// The names as "a, b or c"; with `more`, what may be given instead of a name, as "a, b, c or MORE".
std::string listValues(std::span<const NamedValue> values, const std::string& more = "");

/// The column in which the help of an option begins.
inline constexpr size_t kHelpColumn = 34;

}  // namespace bvhio
