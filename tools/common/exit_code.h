// How a tool ends when nothing went wrong.
#pragma once

namespace bvhio {

/// A tool's exit code. The code for an error is its kind's value, 1 to 5 (core/error.h).
enum class ExitCode : int {
    done = 0,
    findings = 7,  // --check, --diff or --compare found something
};

}  // namespace bvhio
