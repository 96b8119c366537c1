// Where a tool's input comes from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bvhio {

/// Throws Error{usage} when `path` is "-" and standard input is a terminal: nobody types a binary file.
void refuseTerminalInput(const std::string& path);

/// All bytes of a file; "-" is standard input. Throws Error{io}.
std::vector<std::byte> readWholeFile(const std::string& path);

}  // namespace bvhio
