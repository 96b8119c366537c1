// The frame of every tool: the only place that turns an exception into a message and an exit code.
#pragma once

#include <functional>

#include "common/command_line.h"
#include "common/exit_code.h"

namespace bvhio {

/// Runs a tool's body, which declares its options on the command line, calls parse() and works. Returns the
/// exit code: the body's own; 0 after --help or --version; an Error's kind, or 4 when memory or another
/// resource ran out, after one line on standard error.
int runTool(const ToolInfo& tool, int argc, char** argv, const std::function<ExitCode(CommandLine&)>& body);

}  // namespace bvhio
