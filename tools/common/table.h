// Reports as text for people.
#pragma once

#include <ostream>
#include <string>

#include "core/report.h"

namespace bvhio {

/// One line for each value, "key  value" in columns; a key within an object is "object.key". Objects whose
/// keys are numbers, and arrays of plain values, are histograms or lists and take one line. Arrays of objects
/// follow as tables of their own.
void printTable(std::ostream& out, const Report& report);

}  // namespace bvhio
