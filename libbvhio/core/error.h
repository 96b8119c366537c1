// The one exception for bad data from outside. The values of its kinds are the exit codes of the tools.
#pragma once

#include <stdexcept>
#include <string>

namespace bvhio {

/// What went wrong. The value is the exit code of a tool that stops with this error.
enum class ErrorKind : int {
    usage = 1,        // a bad value of an option
    io = 2,           // a missing file, a full disk, a closed pipe
    invalid = 3,      // damaged or meaningless input
    resources = 4,    // out of memory or over a limit
    unsupported = 5,  // valid input that this version cannot read
};

/// Thrown for bad data from outside, never for bugs. The message is one line, without the tool's name and
/// without a full stop at its end. It says what is wrong, where (file, chunk and byte, mesh and vertex), and
/// if possible what to do about it.
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

}  // namespace bvhio
