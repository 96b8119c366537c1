// What a tool says on standard error.
#pragma once

#include <string>
#include <string_view>

namespace bvhio {

enum class LogLevel { quiet, normal, verbose };

/// Starts every line with "<tool>: ". Until this is called the level is normal.
void startLog(const std::string& tool);
void setLogLevel(LogLevel level);

/// Always shown, one line whatever the message holds: control characters become '?'.
void logError(std::string_view message);
/// Not shown with -q.
void logWarning(std::string_view message);
/// Shown with -v.
void logInfo(std::string_view message);

}  // namespace bvhio
