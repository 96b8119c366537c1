#include "common/table.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <utility>
#include <vector>

#include "core/report.h"

namespace bvhio {
namespace {

using Rows = std::vector<std::pair<std::string, Report>>;

std::string floatText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string valueText(const Report& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return "-";
    if (value.is_number_float()) return floatText(value.get<double>());
    if (!value.is_structured()) return value.dump();
    std::string list;
    for (const auto& [key, item] : value.items())
        list += (list.empty() ? "" : ", ") + (value.is_object() ? key + ": " : "") + valueText(item);
    return list.empty() ? "-" : list;
}

/// Whether the value is an object whose keys are numbers: how many there are of each.
bool isHistogram(const Report& value) {
    return value.is_object() && !value.empty() &&
           value.begin().key().find_first_not_of("0123456789") == std::string::npos;
}

bool isListOfObjects(const Report& value) {
    return value.is_array() && (value.empty() || value[0].is_object());
}

/// Collects the values and the lists of objects in a report, with their paths.
void flatten(const Report& report, const std::string& prefix, Rows& values, Rows& lists) {
    for (const auto& [key, value] : report.items()) {
        if (value.is_object() && !isHistogram(value))
            flatten(value, prefix + key + ".", values, lists);
        else
            (isListOfObjects(value) ? lists : values).emplace_back(prefix + key, value);
    }
}

/// Prints rows with each cell as wide as the widest one of its column, except the last cell.
void printColumns(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
    std::vector<size_t> widths;
    for (const auto& row : rows)
        for (size_t i = 0; i < row.size(); ++i) {
            if (i == widths.size()) widths.push_back(0);
            widths[i] = std::max(widths[i], row[i].size());
        }
    for (const auto& row : rows) {
        for (size_t i = 0; i + 1 < row.size(); ++i)
            out << std::left << std::setw(int(widths[i]) + 2) << row[i];
        out << row.back() << '\n';
    }
}

}  // namespace

void printTable(std::ostream& out, const Report& report) {
    Rows values, lists;
    flatten(report, "", values, lists);
    std::vector<std::vector<std::string>> rows;
    for (const auto& [key, value] : values) rows.push_back({key, valueText(value)});
    printColumns(out, rows);

    for (const auto& [key, list] : lists) {
        if (list.empty()) continue;
        rows.assign(1, {});
        for (const auto& [column, value] : list[0].items()) rows[0].push_back(column);
        for (const Report& object : list) {
            rows.emplace_back();
            for (const auto& [column, value] : object.items()) rows.back().push_back(valueText(value));
        }
        out << (values.empty() ? "" : "\n" + key + ":\n");
        printColumns(out, rows);
    }
}

}  // namespace bvhio
