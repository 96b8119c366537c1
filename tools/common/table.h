// Reports as text, for people.
#pragma once

#include <ostream>
#include <string>

#include "core/report_fwd.h"

namespace bvhio {

/// Prints one line for each value, "key  value" in columns; a key within an object is "object.key". An object
/// whose keys are numbers (a histogram) and an array of plain values take one line each. Arrays of objects
/// follow as separate tables.
void printTable(std::ostream& out, const Report& report);

}  // namespace bvhio
