// The exit codes of every tool.
#pragma once

namespace bvhio {

/// 1 to 5 are the values of ErrorKind (core/error.h).
enum class ExitCode : int {
    done = 0,
    usage = 1,        // a bad command line
    io = 2,           // a missing file, a full disk, a closed pipe
    invalid = 3,      // damaged or meaningless input
    resources = 4,    // out of memory or over a limit
    unsupported = 5,  // valid input that this version cannot read
    findings = 7,     // --check, --diff or --compare found something
};

}  // namespace bvhio
