// The lines that a tool prints on standard error.
#pragma once

#include <string>
#include <string_view>

namespace bvhio {

enum class LogLevel { quiet, normal, verbose };

/// Every line starts with "<tool>: ". The level is normal until it is set.
void startLog(const std::string& tool);
void setLogLevel(LogLevel level);
/// Whether lines of logInfo are shown.
bool isVerbose();

/// Always shown, as one line: control characters of the message become '?'.
void logError(std::string_view message);
/// Begins with "note: ". Not shown with -q.
void logNote(std::string_view message);
/// Shown with -v.
void logInfo(std::string_view message);

}  // namespace bvhio
