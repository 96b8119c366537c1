#include "common/help_text.h"

#include <algorithm>

namespace bvhio {
namespace {

constexpr size_t kLineEnd = 110;  // the column at which lines of --help are broken

}  // namespace

std::string withDefault(const std::string& help, const std::string& value) {
    return value.empty() ? help : help + " (default " + value + ")";
}

std::string wrapped(std::string_view text, size_t indent) {
    std::string lines;
    for (size_t width = kLineEnd - kHelpColumn - indent; text.size() > width;) {
        const size_t space = text.rfind(' ', width);
        if (space == std::string_view::npos || space == 0) break;
        lines.append(text.substr(0, space)).append("\n").append(indent, ' ');
        text.remove_prefix(space + 1);
    }
    return lines.append(text);
}

std::string valueRows(std::span<const NamedValue> values) {
    size_t width = 0;
    for (const NamedValue& row : values) width = std::max(width, row.name.size());
    std::string rows;
    for (const NamedValue& row : values)
        rows.append("\n  ")
            .append(row.name)
            .append(width - row.name.size() + 2, ' ')
            .append(wrapped(row.summary, width + 4));
    return rows;
}

std::string listValues(std::span<const NamedValue> values, const std::string& more) {
    std::string list;
    for (size_t i = 0; i < values.size(); ++i) {
        const bool isLast = i + 1 == values.size() && more.empty();
        list.append(i == 0 ? "" : isLast ? " or " : ", ").append(values[i].name);
    }
    return more.empty() ? list : list + " or " + more;
}

}  // namespace bvhio
